// Reads a model of XPPAUT: ordinary differential equations, and chains of them that discretise a
// line, u[1..50]' = d*(u[j-1] - 2*u[j] + u[j+1]) + …
//
// A chain becomes a species on a line of cells, and u[j+1] becomes the value of this species in the
// next cell. Names beyond the ends of the chain, such as u0 and u51, are definitions of the file,
// from which the conditions at the sides are derived.
#include "import/xpp.h"

#include "import/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace cascade::importing {

namespace {

constexpr Dialect xpp_dialect = {.caret_is_power = true, .ignores_case = true};

constexpr ForeignFunction xpp_functions[] = {
    {"exp", 1, "exp(A)"},           {"ln", 1, "log(A)"},         {"log", 1, "log(A)"},
    {"log10", 1, "log(A)/log(10)"}, {"sin", 1, "sin(A)"},        {"cos", 1, "cos(A)"},
    {"tan", 1, "tan(A)"},           {"asin", 1, "asin(A)"},      {"acos", 1, "acos(A)"},
    {"atan", 1, "atan(A)"},         {"atan2", 2, "atan2(A, B)"}, {"sinh", 1, "sinh(A)"},
    {"cosh", 1, "cosh(A)"},         {"tanh", 1, "tanh(A)"},      {"sqrt", 1, "sqrt(A)"},
    {"abs", 1, "abs(A)"},           {"sign", 1, "sign(A)"},      {"heav", 1, "step(0, A)"},
    {"flr", 1, "floor(A)"},         {"max", 2, "max(A, B)"},     {"min", 2, "min(A, B)"},
    {"mod", 2, "mod(A, B)"},        {"pow", 2, "A^B"},
};

class XppModel {
public:
    XppModel(Import& import, XppFile file, Draft& draft)
        : import_(import), file_(std::move(file)), draft_(draft) {}

    bool add() {
        if (file_.rates.empty()) {
            fail({import_.source, 0, 0}, "the file has no equation such as u'=…");
            return false;
        }
        declare();
        for (const XppPair& each : file_.functions) add_function(each);
        for (const XppPair& each : file_.definitions) {
            if (!is_end(each)) add_definition(each);
        }
        for (const XppPair& each : file_.parameters) {
            if (const auto value = formula(each.value)) {
                draft_.parameters.push_back(
                    fmt::format("{}: {}", names_of_[each.name], write_formula(*value)));
            }
        }
        for (const XppPair& each : file_.rates) add_species(each);
        if (!failed_) add_domain();
        if (!failed_) add_stage();
        return !failed_;
    }

private:
    void fail(Span span, std::string why, std::string hint = "") {
        if (!failed_) import_.diagnostics.error(span, std::move(why), std::move(hint));
        failed_ = true;
    }

    void declare() {
        std::set<std::string> known;
        for (const auto* const list : {&file_.rates, &file_.parameters, &file_.definitions}) {
            for (const XppPair& each : *list) {
                if (is_end(each)) continue;
                if (!known.insert(each.name).second) {
                    fail(each.place, fmt::format("'{}' is given twice", each.name));
                }
                names_of_[each.name] = names_.declare(each.name);
            }
        }
        for (const XppPair& each : file_.rates) {
            species_.insert(each.name);
            if (each.is_member) members_.insert(each.name);
            if (file_.has_arrays && !each.is_member) {
                fail(each.place, "a separate equation beside a chain has no counterpart in Cascade",
                     "give the values beyond the ends instead: u0=u1");
            }
        }
    }

    /// Finds the chain that a name such as u0 or u51 continues. The number is 0 if the name lies
    /// before the first element, 1 if after the last, and −1 if there is no such chain.
    std::pair<std::string, int> end_of(const std::string& name) const {
        for (const XppPair& each : file_.rates) {
            if (!each.is_member) continue;
            if (name == fmt::format("{}{}", each.name, file_.first - 1)) return {each.name, 0};
            if (name == fmt::format("{}{}", each.name, file_.last + 1)) return {each.name, 1};
        }
        return {"", -1};
    }
    bool is_end(const XppPair& pair) const { return end_of(pair.name).second >= 0; }

    std::optional<Expression> formula(Span span) {
        // u[j+1] is read as the call of a function "u[".
        const auto read = read_formula(span, import_.sources, import_.diagnostics, xpp_dialect);
        if (!read) {
            failed_ = true;
            return std::nullopt;
        }
        Expression made = replaced(*read, [&](const Expression& part) { return meaning(part); });
        if (mentions(made, "j"))
            fail(span, "the number of an element has no counterpart in Cascade");
        if (failed_) return std::nullopt;
        return made;
    }

    std::optional<Expression> meaning(const Expression& part) {
        const std::string& word = part.text;
        if (part.kind == Expression::Kind::call) {
            if (word == "if") return std::nullopt;
            if (word.ends_with('[')) return neighbour(part);
            if (functions_.contains(word)) return call(names_of_functions_[word], part.of);
            if (auto found = meaning_of(part, xpp_functions)) return found;
            fail(part.span, fmt::format("the function '{}' has no counterpart in Cascade", word));
            return std::nullopt;
        }
        if (arguments_.contains(word)) return name(arguments_[word]);
        if (word == "j") return part;
        if (const auto found = names_of_.find(word); found != names_of_.end()) {
            return name(found->second);
        }
        if (word == "t" || word == "pi") return name(word);
        fail(part.span, fmt::format("'{}' has no meaning here", word));
        return std::nullopt;
    }

    /// Translates an element such as u[j], u[j-1] or u[j+2].
    std::optional<Expression> neighbour(const Expression& part) {
        const std::string chain = part.text.substr(0, part.text.size() - 1);
        const bool is_chain = names_of_.contains(chain) && part.of.size() == 1;
        std::optional<double> offset;
        if (is_chain) {
            offset = value_of(replaced(part.of[0], [](const Expression& inner) {
                return inner.is_name("j") ? std::optional(number(0)) : std::nullopt;
            }));
        }
        if (!offset || !mentions(part.of[0], "j") || *offset != static_cast<int>(*offset) ||
            std::abs(*offset) > 8) {
            fail(part.span, "an element such as u[j] or u[j+1] is expected here");
            return std::nullopt;
        }
        Expression value = name(names_of_[chain]);
        const auto cells = static_cast<int>(*offset);
        if (cells != 0) {
            shifted_.insert(chain);
            const std::string function = cells > 0 ? "east" : "west";
            const std::string text =
                fmt::format("fn {}(u) = shifted(u, {})", function, cells > 0 ? 1 : -1);
            auto& all = draft_.functions;
            if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
            for (int k = 0; k < std::abs(cells); ++k) value = call(function, {value});
        }
        return value;
    }

    /// Adds a function that is written as f(x,y)=….
    void add_function(const XppPair& pair) {
        const std::size_t open = pair.name.find('('), close = pair.name.find(')');
        const std::string name_of_function = pair.name.substr(0, open);
        if (close == std::string::npos || close + 1 != pair.name.size()) {
            return fail(pair.place, "a function such as f(x,y)=… is expected here");
        }
        std::string list;
        std::string word;
        arguments_.clear();
        for (const char letter : pair.name.substr(open + 1, close - open - 1) + ",") {
            if (letter != ',') {
                word += letter;
                continue;
            }
            // 'x' is a coordinate here, so an argument of this name is renamed.
            arguments_[word] = word + "_";
            list += (list.empty() ? "" : ", ") + word + "_";
            word.clear();
        }
        const auto value = formula(pair.value);
        arguments_.clear();
        if (!value) return;
        functions_.insert(name_of_function);
        names_of_functions_[name_of_function] = name_of_function + "_";
        bool reads_others = false;
        for (const auto& [foreign, own] : names_of_) reads_others |= mentions(*value, own);
        if (reads_others) {
            return fail(pair.place,
                        "a function that reads parameters has no counterpart in Cascade",
                        "make them arguments of the function");
        }
        draft_.functions.push_back(
            fmt::format("fn {}_({}) = {}", name_of_function, list, write_formula(*value)));
    }

    void add_definition(const XppPair& pair) {
        const auto value = formula(pair.value);
        if (!value) return;
        draft_.definitions.push_back(
            fmt::format("{} = {}", names_of_[pair.name], write_formula(*value)));
    }

    void add_species(const XppPair& pair) {
        const auto rate = formula(pair.value);
        if (!rate || failed_) return;
        const std::string& own = names_of_[pair.name];
        const auto diffusion = import_.diffusion.find(pair.name);
        Expression made = *rate;
        if (diffusion != import_.diffusion.end()) {
            made = operation(operation(name(diffusion->second), "*", call("lap", {name(own)})), "+",
                             made);
        }
        draft_.rates.push_back(fmt::format("{}' = {}", own, write_formula(made)));
        std::string start = "0";
        for (const XppPair& each : file_.starts) {
            if (each.name != pair.name) continue;
            const auto value = formula(each.value);
            if (value) start = write_formula(*value);
        }
        draft_.starts.push_back(fmt::format("{}: {}", own, start));
    }

    /// The index of the element of a chain that a formula such as u50 names. Empty if the formula
    /// is no element of the chain.
    std::optional<long> element(Span span, const std::string& chain) const {
        std::string words;
        for (const char c : import_.sources.text(span)) {
            words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
        if (!words.starts_with(chain)) return std::nullopt;
        const auto value = plain_number(words.substr(chain.size()));
        if (!value) return std::nullopt;
        return static_cast<long>(*value);
    }

    void add_domain() {
        const bool diffuses = !import_.diffusion.empty();
        draft_.has_other_differences = diffuses;
        for (const auto& [wanted, value] : import_.diffusion) {
            if (!species_.contains(wanted)) {
                return fail({import_.source, 0, 0},
                            fmt::format("there is no species '{}' to diffuse", wanted));
            }
        }
        if (!file_.has_arrays) {
            draft_.domain = {diffuses ? "grid: 128, 128" : "grid: 2"};
            if (!diffuses) {
                draft_.remarks.push_back(
                    "The model has no space, so both cells do the same. --diffusion NAME=D lets "
                    "species diffuse on a plane.");
            }
            return;
        }
        const long count = file_.last - file_.first + 1;
        draft_.domain = {fmt::format("grid: {}", count)};
        std::map<std::string, std::array<std::string, 2>> sides;
        for (const XppPair& each : file_.definitions) {
            const auto [chain, side] = end_of(each.name);
            if (side < 0) continue;
            const auto other = element(each.value, chain);
            std::string& made = sides[chain][static_cast<std::size_t>(side)];
            if (other && *other == (side == 0 ? file_.first : file_.last)) {
                made = "noflux";
            } else if (other && *other == (side == 0 ? file_.last : file_.first)) {
                made = "periodic";
            } else if (const auto value = formula(each.value)) {
                // The value beyond the side: see import/visual_pde_sides.cpp.
                made =
                    fmt::format("slope(2 * ({} - {}))", write_formula(*value, 5), names_of_[chain]);
            }
        }
        bool is_periodic = !shifted_.empty();
        for (const std::string& chain : shifted_) {
            is_periodic &= sides[chain][0] == "periodic" && sides[chain][1] == "periodic";
        }
        draft_.domain.push_back(is_periodic ? "boundary: periodic" : "boundary: noflux");
        if (is_periodic) return;
        for (const std::string& chain : members_) {
            for (std::size_t side = 0; side < 2; ++side) {
                const std::string& made = sides[chain][side];
                if (made == "noflux") continue;
                if (made.empty()) {
                    if (!shifted_.contains(chain)) continue;
                    return fail({import_.source, 0, 0},
                                fmt::format("the file gives no value for {}{}", chain,
                                            side == 0 ? file_.first - 1 : file_.last + 1));
                }
                draft_.sides.push_back(
                    fmt::format("{}.{}: {}", names_of_[chain], side == 0 ? "left" : "right", made));
            }
        }
    }

    void add_stage() {
        const auto option = [&](const char* wanted, double usual) {
            const auto found = file_.options.find(wanted);
            return found == file_.options.end() ? usual
                                                : plain_number(found->second).value_or(usual);
        };
        // XPPAUT's defaults are 0.05 and 20.
        draft_.speed = option("dt", 0.05);
        const double total = option("total", 20);
        if (!(draft_.speed > 0) || !(total > 0)) {
            return fail({import_.source, 0, 0}, "'dt' and 'total' must be above 0");
        }
        const auto method = file_.options.find("meth");
        const std::string scheme = method == file_.options.end() ? "rungekutta" : method->second;
        draft_.stage = {fmt::format("duration: {}", number_text(total))};
        if (scheme.starts_with("rungekutta") || scheme.starts_with("4")) {
            draft_.stage.emplace_back("solver: rk4");
        } else if (scheme.starts_with("modeuler")) {
            draft_.stage.emplace_back("solver: rk2");
        } else if (!scheme.starts_with("euler")) {
            draft_.stage.emplace_back("solver: rk4");
            draft_.remarks.push_back(fmt::format(
                "XPPAUT's method '{}' is replaced by rk4 with the same step.", plain_line(scheme)));
        }
        draft_.stage.push_back("show: " + names_of_[file_.rates.front().name]);
    }

    Import& import_;
    XppFile file_;
    Draft& draft_;
    FreeNames names_;
    std::map<std::string, std::string> names_of_, names_of_functions_, arguments_;
    std::set<std::string> species_, members_, functions_, shifted_;
    bool failed_ = false;
};

}  // namespace

std::optional<Draft> read_xpp(Import& import) {
    auto file = read_xpp_statements(import);
    if (!file) return std::nullopt;
    Draft draft;
    draft.about = {fmt::format("Imported from a model of XPPAUT: {}", plain_line(import.name))};
    if (!XppModel(import, std::move(*file), draft).add()) return std::nullopt;
    return draft;
}

}  // namespace cascade::importing
