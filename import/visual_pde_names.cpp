// The meaning of names and functions in formulas of VisualPDE, which are GLSL with `^`.
#include "import/visual_pde.h"

#include "import/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::importing {

namespace {

constexpr Dialect visual_pde_dialect = {.caret_is_power = true, .implies_products = true};

constexpr ForeignFunction visual_pde_functions[] = {
    {"exp", 1, "exp(A)"},
    {"log", 1, "log(A)"},
    {"sin", 1, "sin(A)"},
    {"cos", 1, "cos(A)"},
    {"tan", 1, "tan(A)"},
    {"asin", 1, "asin(A)"},
    {"acos", 1, "acos(A)"},
    {"atan", 1, "atan(A)"},
    {"atan", 2, "atan2(A, B)"},
    {"sinh", 1, "sinh(A)"},
    {"cosh", 1, "cosh(A)"},
    {"tanh", 1, "tanh(A)"},
    {"sech", 1, "1/cosh(A)"},
    {"sqrt", 1, "sqrt(A)"},
    {"inversesqrt", 1, "1/sqrt(A)"},
    {"exp2", 1, "2^A"},
    {"log2", 1, "log(A)/log(2)"},
    {"abs", 1, "abs(A)"},
    {"sign", 1, "sign(A)"},
    {"floor", 1, "floor(A)"},
    {"ceil", 1, "ceil(A)"},
    {"round", 1, "round(A)"},
    {"fract", 1, "A - floor(A)"},
    {"mod", 2, "mod(A, B)"},
    {"min", 2, "min(A, B)"},
    {"max", 2, "max(A, B)"},
    {"pow", 2, "A^B"},
    {"safepow", 2, "A^B"},
    {"step", 2, "step(A, B)"},
    {"clamp", 3, "clamp(A, B, C)"},
    {"mix", 3, "mix(A, B, C)"},
    {"smoothstep", 3, "smoothstep(A, B, C)"},
    {"H", 1, "smoothstep(-0.01, 0.01, A)"},
    {"H", 2, "smoothstep(-0.01, 0.01, A - B)"},
    {"ind", 1, "A"},
    {"float", 1, "A"},
};

/// The parts of `text` between the marks, as the beginning and the end of each part.
std::vector<std::pair<std::size_t, std::size_t>> parts_of(std::string_view text, char mark) {
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= text.size(); ++at) {
        if (at < text.size() && text[at] != mark) continue;
        parts.emplace_back(begin, at);
        begin = at + 1;
    }
    return parts;
}

std::string trimmed(std::string_view text) { return plain_line(text); }

}  // namespace

void VisualPdeNames::fail(Span span, std::string why, std::string hint) {
    if (!has_failed_) import_.diagnostics.error(span, std::move(why), std::move(hint));
    has_failed_ = true;
}

bool VisualPdeNames::declare() {
    const auto count = plain_number(options_.text("numSpecies"));
    const auto algebraic = plain_number(options_.text("numAlgebraicSpecies"));
    if (!count || *count < 1 || *count > 4 || !algebraic || *algebraic < 0 ||
        *algebraic >= *count) {
        fail(options_.source(import_, "numSpecies"), "1 to 4 species are expected");
        return false;
    }
    algebraic_ = static_cast<std::size_t>(*algebraic);
    std::vector<std::string> wanted;
    std::string word;
    for (const char letter : options_.text("speciesNames") + " ") {
        if (std::isalnum(static_cast<unsigned char>(letter)) || letter == '_') {
            word += letter;
        } else if (!word.empty()) {
            wanted.push_back(std::exchange(word, ""));
        }
    }
    for (const char* const other : {"u", "v", "w", "q"}) wanted.emplace_back(other);
    for (std::size_t k = 0; species_.size() < static_cast<std::size_t>(*count); ++k) {
        if (own_species_.contains(wanted[k])) continue;
        species_.push_back(names_.declare(wanted[k]));
        own_species_[wanted[k]] = species_.back();
    }
    const auto dimension = plain_number(options_.text("dimension"));
    is_line_ = (dimension && *dimension == 1) || options_.is_true("oneDimensional");
    if (!dimension || (*dimension != 1 && *dimension != 2)) {
        fail(options_.source(import_, "dimension"), "1 or 2 dimensions are expected");
        return false;
    }
    if (!options_.is_true("crossDiffusion")) algebraic_ = 0;
    if (options_.is_true("automataMode")) std::swap(maps_, algebraic_);
    return declare_parameters() && measure() && find_moving_mask();
}

/// Finds out whether the mask reads t or a species. If so, adds a definition of the mask to the
/// script.
bool VisualPdeNames::find_moving_mask() {
    if (!options_.is_true("domainViaIndicatorFun")) return true;
    Diagnostics ignored;
    const Span span = options_.source(import_, "domainIndicatorFun");
    const auto read = read_formula(span, import_.sources, ignored, visual_pde_dialect);
    if (!read) return true;  // The code that reads the mask reports the error.
    const auto moves = [&](const Expression& part, const auto& again) -> bool {
        if (part.is_name("t") || own_species_.contains(part.text)) return true;
        return std::any_of(part.of.begin(), part.of.end(),
                           [&](const Expression& each) { return again(each, again); });
    };
    if (moves(*read, moves)) inside_ = names_.fresh("inside");
    return true;
}

std::string VisualPdeNames::kind_of_sides(std::size_t species) const {
    std::string kind = plain_line(options_.text("boundaryConditions", species));
    std::transform(kind.begin(), kind.end(), kind.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return kind;
}

/// Reads parameters such as "D = 1 in [0, 2]; k = 2*D".
bool VisualPdeNames::declare_parameters() {
    const Span whole = options_.source(import_, "kineticParams");
    const std::string_view text = import_.sources.text(whole);
    for (const auto& [begin, end] : parts_of(text, ';')) {
        const std::string_view part = text.substr(begin, end - begin);
        const std::size_t sign = part.find('=');
        if (trimmed(part).empty()) continue;
        const auto place = [&](std::size_t from, std::size_t to) {
            return Span{whole.source, static_cast<std::uint32_t>(begin + from),
                        static_cast<std::uint32_t>(begin + to)};
        };
        if (sign == std::string_view::npos) {
            fail(place(0, part.size()), "a parameter needs '='");
            return false;
        }
        Parameter made;
        made.foreign = trimmed(part.substr(0, sign));
        std::size_t stop = part.size();
        const std::size_t in = part.find(" in", sign);
        if (in != std::string_view::npos) {
            stop = in;
            const std::size_t open = part.find_first_of("[(", in);
            const std::size_t close = part.find_first_of("])", in);
            std::vector<double> limits;
            if (open != std::string_view::npos && close != std::string_view::npos && open < close) {
                const std::string_view list = part.substr(open + 1, close - open - 1);
                for (const auto& [from, to] : parts_of(list, ',')) {
                    if (const auto value = plain_number(list.substr(from, to - from))) {
                        limits.push_back(*value);
                    }
                }
            }
            const bool has_step = limits.size() == 3;
            if (limits.size() >= 2 && limits.front() < limits.back()) {
                made.range = fmt::format(" in {} .. {}", number_text(limits.front()),
                                         number_text(limits.back()));
                if (has_step && limits[1] > 0 && limits[1] <= limits[2] - limits[0]) {
                    made.range += " step " + number_text(limits[1]);
                }
            }
        }
        made.value = place(sign + 1, stop);
        const bool is_name = !made.foreign.empty() &&
                             std::all_of(made.foreign.begin(), made.foreign.end(), [](char c) {
                                 return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
                             });
        if (!is_name || std::isdigit(static_cast<unsigned char>(made.foreign[0]))) {
            fail(place(0, sign), "this is not the name of a parameter");
            return false;
        }
        made.own = names_.declare(made.foreign);
        if (const auto value = plain_number(import_.sources.text(made.value))) {
            values_[made.own] = *value;
        }
        parameters_.push_back(std::move(made));
    }
    return true;
}

bool VisualPdeNames::measure() {
    const auto scale = constant("domainScale"), step = constant("spatialStep");
    if (!scale || !step) return false;
    if (!(*scale > 0) || !(*step > 0) || *scale / *step > 8192) {
        fail(options_.source(import_, "spatialStep"), "a domain of 1 to 8192 cells is expected");
        return false;
    }
    columns = std::max<std::int64_t>(static_cast<std::int64_t>(*scale / *step + 1e-9), 2);
    rows = is_line_ ? 1 : columns;
    // Finite differences must use VisualPDE's spacing, so its step is kept and the width of the
    // domain is rounded.
    spacing = *step;
    width = height = spacing * static_cast<double>(columns);
    if (std::abs(width / *scale - 1) > 1e-6) {
        draft_.remarks.push_back(
            fmt::format("VisualPDE's domain is {} wide, which is no whole number of steps; here it "
                        "is {} wide.",
                        number_text(*scale), number_text(width)));
    }
    return true;
}

std::optional<double> VisualPdeNames::constant(const std::string& key) {
    auto formula_of_key = option(key, Where::start);
    if (!formula_of_key) return std::nullopt;
    for (int depth = 0; depth < 20; ++depth) {
        if (const auto value = value_of(*formula_of_key)) return value;
        formula_of_key = replaced(*formula_of_key, [&](const Expression& part) {
            const auto found = values_.find(part.text);
            return found == values_.end() ? std::nullopt : std::optional(number(found->second));
        });
    }
    fail(options_.source(import_, key), "a number is expected here");
    return std::nullopt;
}

std::optional<Expression> VisualPdeNames::option(const std::string& key, Where where) {
    return formula(options_.source(import_, key), where);
}

std::optional<Expression> VisualPdeNames::formula(Span span, Where where) {
    if (trimmed(import_.sources.text(span)).empty()) return number(0);
    const auto read = read_formula(span, import_.sources, import_.diagnostics, visual_pde_dialect);
    if (!read) {
        has_failed_ = true;
        return std::nullopt;
    }
    Expression made = replaced(*read, [&](const Expression& part) { return meaning(part, where); });
    made = with_safe_powers(made);
    if (made.depth > deepest_formula) fail(span, "the formula is nested too deep");
    if (has_failed_) return std::nullopt;
    return made;
}

/// Powers in VisualPDE have the sign of their base, unless the exponent rounds to an even number.
/// For whole exponents this is the usual power.
Expression VisualPdeNames::with_safe_powers(const Expression& formula) {
    if (formula.depth > deepest_formula) return formula;
    Expression made = formula;
    for (Expression& operand : made.of) operand = with_safe_powers(operand);
    if (made.kind != Expression::Kind::binary || made.text != "^") return made;
    auto exponent = value_of(made.of[1]);
    if (const auto found = values_.find(made.of[1].text); found != values_.end()) {
        exponent = found->second;
    }
    const bool is_positive = value_of(made.of[0]).value_or(-1) >= 0 || made.of[0].text == "abs" ||
                             made.of[0].text == "exp";
    if (!exponent || *exponent == std::round(*exponent) || is_positive) return made;
    const bool is_even = std::fmod(std::round(*exponent), 2.0) == 0;
    const Expression base = made.of[0];
    made.of[0] = call("abs", {base});
    return is_even ? made : operation(call("sign", {base}), "*", made);
}

bool VisualPdeNames::is_uniform(const Expression& formula) const {
    if (formula.kind == Expression::Kind::name) {
        const auto found =
            std::find_if(parameters_.begin(), parameters_.end(),
                         [&](const Parameter& each) { return each.own == formula.text; });
        const bool is_number = found != parameters_.end() && values_.contains(found->own);
        return is_number || formula.text == "pi";
    }
    if (formula.kind == Expression::Kind::call && !value_of(formula)) return false;
    const bool is_nothing =
        formula.text == "*" && (formula.of[0].is_number("0") || formula.of[1].is_number("0"));
    if (is_nothing) return true;
    return std::all_of(formula.of.begin(), formula.of.end(),
                       [&](const Expression& operand) { return is_uniform(operand); });
}

void VisualPdeNames::add_function(const std::string& text) {
    auto& all = draft_.functions;
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
}

/// A position in the unit of length. y points upwards in VisualPDE.
Expression VisualPdeNames::place(char axis) {
    const Expression from =
        axis == 'x' ? name("domain.x") : operation(name("domain.height"), "-", name("domain.y"));
    if (axis == 'y' && is_line_) return name("domain.y");
    const auto least = option(axis == 'x' ? "minX" : "minY", Where::mask);
    return least ? operation(from, "+", *least) : from;
}

void VisualPdeNames::add_parameters() {
    std::set<std::string> written;
    std::vector<std::string> unread;
    // A formula may read parameters that are declared before or after its own parameter, so this
    // repeats until no further parameter is read.
    std::vector<std::string> texts(parameters_.size());
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (std::size_t k = 0; k < parameters_.size(); ++k) {
            if (!parameters_[k].is_read || !texts[k].empty()) continue;
            const auto value = formula(parameters_[k].value, Where::start);
            if (!value) return;
            texts[k] = fmt::format("{}: {}{}", parameters_[k].own, write_formula(*value),
                                   parameters_[k].range);
            goes_on = true;
        }
    }
    std::vector<std::string> all;
    for (std::size_t k = 0; k < texts.size(); ++k) {
        if (!texts[k].empty()) {
            all.push_back(texts[k]);
        } else {
            unread.push_back(parameters_[k].foreign);
        }
    }
    draft_.parameters.insert(draft_.parameters.begin(), all.begin(), all.end());
    if (unread.empty()) return;
    std::string list;
    for (const std::string& each : unread) list += (list.empty() ? "" : ", ") + each;
    draft_.about.push_back("Left out, because no formula reads them: " + list + ".");
}

std::optional<Expression> VisualPdeNames::meaning(const Expression& part, Where where) {
    if (part.kind == Expression::Kind::name) {
        auto found = named(part, where);
        if (!found) fail(part.span, fmt::format("'{}' has no meaning here", part.text));
        return found;
    }
    const std::string& function = part.text;
    if (function == "if") return std::nullopt;
    if (function.ends_with('[')) return at_other_cell(part);
    if (function.starts_with("I_S") || function.starts_with("I_T")) return picture(part, where);
    if (auto found = meaning_of(part, visual_pde_functions)) return found;
    if (function == "Bump" && (part.of.size() == 3 || part.of.size() == 2)) {
        Expression square = operation(operation(place('x'), "-", part.of[0]), "^", number(2));
        if (part.of.size() == 3 && !is_line_) {
            square = operation(square, "+",
                               operation(operation(place('y'), "-", part.of[1]), "^", number(2)));
        }
        add_function("fn bump(d2) = if(d2 < 1, exp(1 - 1 / (1 - d2)), 0)");
        return call("bump", {operation(square, "/", operation(part.of.back(), "^", number(2)))});
    }
    if (function == "Gauss" && part.of.size() >= 3 && part.of.size() <= 4) {
        add_function(
            "fn bell(x, y, sx, sy) = exp(-(x^2 / (2 * sx^2) + y^2 / (2 * sy^2))) / "
            "(2 * pi * sx * sy)");
        return call("bell", {operation(place('x'), "-", part.of[0]),
                             operation(place('y'), "-", part.of[1]), part.of[2], part.of.back()});
    }
    // A product without a sign: k(1 - u).
    Expression factor = part;
    factor.kind = Expression::Kind::name;
    factor.of.clear();
    if (auto found = part.of.size() == 1 ? named(factor, where) : std::nullopt) {
        return operation(std::move(*found), "*", part.of[0]);
    }
    fail(part.span, fmt::format("the function '{}' of {} arguments has no counterpart in Cascade",
                                function, part.of.size()));
    return std::nullopt;
}

}  // namespace cascade::importing
