// Translates the formula of a pattern of Ready: assignments in OpenCL for one step of Euler's
// method.
//
// Assignments are executed in order, and each name denotes its last assignment. In the script each
// assignment is a separate definition. After the step, a chemical has its last assigned value, if
// any, plus timestep times its delta.
#include "import/formula_words.h"
#include "import/ready.h"
#include "import/ready_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace cascade::importing {

namespace {

/// An assignment. It becomes a definition, or is written where it is used.
struct Assigned {
    std::string name;  ///< The name in the script.
    Expression value;
    bool is_delta = false;
    int uses = 0;
};

class ReadyFormula {
public:
    ReadyFormula(ReadyPattern& pattern, Draft& draft) : pattern_(pattern), draft_(draft) {}

    bool read(const pugi::xml_node& formula) {
        if (formula.first_child().next_sibling()) {
            return fail(place_of(pattern_.import, formula), "the formula has comments of XML");
        }
        auto written = formula_words(text_of(pattern_.import, formula), pattern_.import.sources,
                                     pattern_.import.diagnostics, dialect_);
        if (!written) return false;
        const auto words = unroll_loops(std::move(*written));
        FormulaReader reader(words, pattern_.import.diagnostics, dialect_);
        while (!reader.has_failed() && reader.next().kind != FormulaWord::Kind::end) {
            if (!reader.takes(";")) statement(reader);
        }
        return !reader.has_failed() && !failed_;
    }

    void finish();

private:
    bool fail(Span span, std::string why, std::string hint = "") {
        if (!failed_) pattern_.import.diagnostics.error(span, std::move(why), std::move(hint));
        failed_ = true;
        return false;
    }

    void statement(FormulaReader& reader);
    void assign(const FormulaWord& target, const std::string& sign, Expression value);
    Expression resolved(const Expression& value);
    std::optional<Expression> meaning(const Expression& part);
    std::optional<Expression> named(const std::string& word);
    void add_function(const std::string& text) {
        auto& all = draft_.functions;
        if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
    }
    std::optional<Expression> blurred(const std::string& species);
    std::optional<Expression> neighbour(const std::string& species, std::string_view place);
    Expression bilaplacian(const Expression& of);
    void check_conditions(const Expression& value, bool is_condition);
    void count_uses(const Expression& value);
    Expression inlined(const Expression& value) const;

    ReadyPattern& pattern_;
    Draft& draft_;
    const Dialect dialect_ = {.is_c = true};
    std::vector<Assigned> assigned_;
    /// For each name of Ready, the index of its last assignment in `assigned_`.
    std::map<std::string, std::size_t> latest_;
    bool failed_ = false;
};

/// Reads `float4 a = …, b = …;` or `a += …;`.
void ReadyFormula::statement(FormulaReader& reader) {
    constexpr std::string_view types[] = {"const", "float", "float4", "double", "double4"};
    constexpr std::string_view words_of_c[] = {"for", "while", "if", "else", "return", "do", "int"};
    while (std::find(std::begin(types), std::end(types), reader.next().text) != std::end(types)) {
        reader.take();
    }
    do {
        const FormulaWord target = reader.take();
        if (std::find(std::begin(words_of_c), std::end(words_of_c), target.text) !=
            std::end(words_of_c)) {
            return reader.fail(target.span,
                               fmt::format("'{}' of OpenCL has no counterpart in Cascade",
                                           target.text));
        }
        if (target.kind != FormulaWord::Kind::name) {
            return reader.fail(target.span, "an assignment should begin here");
        }
        if (reader.at(",")) continue;  // A declaration without a value.
        const FormulaWord sign = reader.take();
        if (sign.text == ";") return;
        if (sign.text == "[")
            return reader.fail(sign.span, "arrays have no counterpart in Cascade");
        if (sign.text == ".") {
            return reader.fail(sign.span, "components of vectors have no counterpart in Cascade");
        }
        constexpr std::string_view signs[] = {"=", "+=", "-=", "*=", "/="};
        if (std::find(std::begin(signs), std::end(signs), sign.text) == std::end(signs)) {
            return reader.fail(sign.span, "'=' is missing here");
        }
        Expression value = reader.expression();
        if (reader.has_failed()) return;
        check_conditions(value, false);
        assign(target, sign.text, resolved(value));
        if (failed_) return reader.stop();
    } while (reader.takes(","));
    reader.expect(";");
}

void ReadyFormula::assign(const FormulaWord& target, const std::string& sign, Expression value) {
    Assigned made;
    made.is_delta = target.text.starts_with("delta_") &&
                    ready_chemical_number(target.text.substr(6), pattern_.species.size());
    if (sign != "=") {
        auto before = named(target.text);
        if (!before) {
            fail(target.span, fmt::format("'{}' has no value yet", target.text));
            return;
        }
        value = operation(std::move(*before), sign.substr(0, 1), std::move(value));
    }
    const auto chemical = ready_chemical_number(target.text, pattern_.species.size());
    made.name = pattern_.names.fresh(chemical ? pattern_.species[*chemical] + "_new" : target.text);
    made.value = std::move(value);
    if (made.value.depth > deepest_formula) {
        fail(target.span, "the assignments are nested too deep");
        return;
    }
    latest_[target.text] = assigned_.size();
    assigned_.push_back(std::move(made));
}

/// A comparison of vectors is -1 or 0 in OpenCL, so it may only be used as a condition.
void ReadyFormula::check_conditions(const Expression& value, bool is_condition) {
    constexpr std::string_view comparisons[] = {"<", "<=", ">", ">=", "==", "!="};
    const bool compares = std::find(std::begin(comparisons), std::end(comparisons), value.text) !=
                              std::end(comparisons) ||
                          (value.kind == Expression::Kind::call && value.text.starts_with("is"));
    if (compares && !is_condition) {
        fail(value.span,
             "a comparison is used as a number here, and in OpenCL a true comparison of vectors is "
             "-1");
    }
    const bool combines = value.text == "and" || value.text == "or" || value.text == "not";
    for (std::size_t k = 0; k < value.of.size(); ++k) {
        const bool chooses = value.kind == Expression::Kind::call &&
                             ((value.text == "if" && k == 0) || (value.text == "select" && k == 2));
        check_conditions(value.of[k], chooses || combines);
    }
}

Expression ReadyFormula::resolved(const Expression& value) {
    return replaced(value, [&](const Expression& part) { return meaning(part); });
}

std::optional<Expression> ReadyFormula::meaning(const Expression& part) {
    if (part.kind == Expression::Kind::name) {
        auto found = named(part.text);
        if (!found) fail(part.span, fmt::format("'{}' has no meaning here", part.text));
        return found;
    }
    Expression function = part;
    for (const std::string_view prefix : {"native_", "half_"}) {
        if (function.text.starts_with(prefix)) function.text.erase(0, prefix.size());
    }
    if (function.text == "if") return std::nullopt;
    if (function.text == "clamp" && function.of.size() == 3) {
        // OpenCL turns an undefined value into the lower limit.
        add_function("fn clamped(a, low, high) = if(a > low, min(a, high), low)");
        function.text = "clamped";
        return function;
    }
    auto found = meaning_of(function, opencl_functions);
    if (!found) {
        fail(part.span,
             fmt::format("the function '{}' of {} arguments has no counterpart in Cascade",
                         part.text, part.of.size()));
    }
    return found;
}

/// What a name of Ready means at this place of the formula.
std::optional<Expression> ReadyFormula::named(const std::string& word) {
    if (const auto found = latest_.find(word); found != latest_.end()) {
        return name(assigned_[found->second].name);
    }
    if (const auto chemical = ready_chemical_number(word, pattern_.species.size())) {
        return name(pattern_.species[*chemical]);
    }
    if (const auto found = pattern_.parameters.find(word); found != pattern_.parameters.end()) {
        return name(found->second);
    }
    if (word == "timestep") {
        draft_.may_shorten = false;
        return name("speed");
    }
    if (word == "dx") return name("domain.spacing");
    if (word == "M_PI" || word == "M_PI_F") return name("pi");
    const auto cells = [&](std::size_t axis) {
        return operation(number(0.5), "/", number(static_cast<double>(pattern_.cells[axis])));
    };
    if (word == "x_pos") return operation(name("sx"), "-", cells(0));
    if (word == "y_pos") return operation(operation(number(1), "-", name("sy")), "-", cells(1));
    if (word == "z_pos") return operation(name("sz"), "-", cells(2));
    const std::size_t line = word.rfind('_');
    if (line == std::string::npos) return std::nullopt;
    const std::string before = word.substr(0, line), after = word.substr(line + 1);
    if (const auto chemical = ready_chemical_number(after, pattern_.species.size())) {
        if (before == "delta") return number(0);
        Expression function = call(before, {name(pattern_.species[*chemical])});
        if (before.starts_with("sobel")) {
            for (const char letter : std::string_view("ewns"))
                neighbour("", std::string(1, letter));
        }
        if (before == "gaussian") return blurred(pattern_.species[*chemical]);
        if (pattern_.has_nine_cells && before == "bilaplacian") return bilaplacian(function.of[0]);
        if (pattern_.has_nine_cells && before == "trilaplacian") {
            return call("lap", {bilaplacian(function.of[0])});
        }
        if (auto found = meaning_of(function, ready_operators)) return found;
    }
    if (const auto chemical = ready_chemical_number(before, pattern_.species.size())) {
        return neighbour(pattern_.species[*chemical], after);
    }
    return std::nullopt;
}

/// Ready's stencil of 21 cells (Patra and Karttunen 2006). With L9 and L5, the Laplacians of nine
/// and of five cells, it is L5 (2 L9 - L5).
Expression ReadyFormula::bilaplacian(const Expression& of) {
    add_function("fn five_cells(u) = dxx(u) + dyy(u)");
    add_function("fn bilaplacian(u) = five_cells(2 * lap(u) - five_cells(u))");
    return call("bilaplacian", {of});
}

/// A weighted mean over 5 × 5 cells.
std::optional<Expression> ReadyFormula::blurred(const std::string& species) {
    if (pattern_.axes() != 2) return std::nullopt;
    add_function(
        "fn weight(cells) = if(cells < 0.5, 41, if(cells < 1.2, 26, if(cells < 1.5, 16,\n"
        "                      if(cells < 2.1, 7, if(cells < 2.4, 4, 1))))) / 273");
    const std::string text =
        pattern_.has_spacing()
            ? "convolve(weight(distance / domain.spacing) / domain.spacing^2, {}, "
              "2.9 * domain.spacing)"
            : "convolve(weight(distance), {}, 2.9)";
    return name(fmt::format(fmt::runtime(text), species));
}

/// The value in the cell at a place such as "ne" or "w2". Adds the functions that read this cell.
std::optional<Expression> ReadyFormula::neighbour(const std::string& species,
                                                  std::string_view place) {
    Expression value = name(species);
    while (!place.empty()) {
        const auto* const found =
            std::find_if(std::begin(ready_neighbours), std::end(ready_neighbours),
                         [&](const Neighbour& each) { return each.letter == place.front(); });
        if (found == std::end(ready_neighbours)) return std::nullopt;
        place.remove_prefix(1);
        int times = 1;
        if (!place.empty() && place.front() >= '2' && place.front() <= '9') {
            times = place.front() - '0';
            place.remove_prefix(1);
        }
        for (int k = 0; k < times; ++k) value = call(std::string(found->function), {value});
        add_function(fmt::format("fn {}(u) = shifted(u, {})", found->function, found->cells));
    }
    return value;
}

void ReadyFormula::count_uses(const Expression& value) {
    if (value.kind == Expression::Kind::name) {
        for (Assigned& each : assigned_) {
            if (each.name != value.text) continue;
            if (++each.uses == 1) count_uses(each.value);
        }
    }
    for (const Expression& operand : value.of) count_uses(operand);
}

/// `value`, in which each delta that is used only once is written in place of its name.
Expression ReadyFormula::inlined(const Expression& value) const {
    return replaced(value, [&](const Expression& part) -> std::optional<Expression> {
        for (const Assigned& each : assigned_) {
            if (each.name == part.text && each.is_delta && each.uses == 1 && part.of.empty()) {
                return inlined(each.value);
            }
        }
        return std::nullopt;
    });
}

void ReadyFormula::finish() {
    std::vector<Expression> rates;
    for (std::size_t k = 0; k < pattern_.species.size(); ++k) {
        const std::string chemical = ready_chemical(k);
        Expression rate = named("delta_" + chemical).value_or(number(0));
        if (latest_.contains(chemical)) {
            draft_.may_shorten = false;
            const Expression change = operation(*named(chemical), "-", name(pattern_.species[k]));
            rate = operation(std::move(rate), "+", operation(change, "/", name("speed")));
        }
        count_uses(rate);
        rates.push_back(std::move(rate));
    }
    for (const Assigned& each : assigned_) {
        const bool is_inlined = each.is_delta && each.uses == 1;
        if (each.uses == 0 || is_inlined) continue;
        draft_.definitions.push_back(
            fmt::format("{} = {}", each.name, write_formula(inlined(each.value))));
    }
    for (std::size_t k = 0; k < rates.size(); ++k) {
        draft_.rates.push_back(
            fmt::format("{}' = {}", pattern_.species[k], write_formula(inlined(rates[k]))));
    }
    std::vector<std::string> parameters;
    std::string unread;
    for (const auto& [foreign, own] : pattern_.parameters) {
        const auto reads = [&, &wanted = own](const std::vector<std::string>& statements) {
            return std::any_of(statements.begin(), statements.end(),
                               [&](const std::string& each) { return has_word(each, wanted); });
        };
        const bool is_read = reads(draft_.parameters) || reads(draft_.starts) ||
                             reads(draft_.definitions) || reads(draft_.rates);
        if (is_read) {
            parameters.push_back(
                fmt::format("{}: {}", own, number_text(pattern_.values.at(foreign))));
        } else {
            unread += (unread.empty() ? "" : ", ") + foreign;
        }
    }
    draft_.parameters.insert(draft_.parameters.begin(), parameters.begin(), parameters.end());
    if (!unread.empty()) {
        draft_.about.push_back("Left out, because no formula reads them: " + unread + ".");
    }
}

}  // namespace

bool add_ready_formula(ReadyPattern& pattern, const pugi::xml_node& formula, Draft& draft) {
    ReadyFormula reader(pattern, draft);
    if (!reader.read(formula)) return false;
    reader.finish();
    return true;
}

}  // namespace cascade::importing
