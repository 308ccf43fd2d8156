// Breaks sums between their top-level terms, and fills lines up to a width that is estimated. If
// the formula is a long fraction, breaks its numerator.
#include "lang/equations/equation_lines.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>

namespace cascade {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// The command that begins at a backslash, such as `\frac` or `\,`.
std::string_view command_at(std::string_view formula, std::size_t at) {
    std::size_t end = at + 1;
    while (end < formula.size() && is_letter(formula[end])) ++end;
    return formula.substr(at, std::max(end, at + 2) - at);
}

/// By how much a command changes the nesting depth of brackets, groups or environments: 1, 0 or −1.
int deeper_after(std::string_view command) {
    if (command == "\\left" || command == "\\begin" || command == "\\lfloor" ||
        command == "\\lceil") {
        return 1;
    }
    const bool closes =
        command == "\\right" || command == "\\end" || command == "\\rfloor" || command == "\\rceil";
    return closes ? -1 : 0;
}

/// The terms of a sum. Each term except the first begins with its sign.
std::vector<std::string_view> terms_of(std::string_view formula) {
    std::vector<std::string_view> terms;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t at = 0; at < formula.size(); ++at) {
        const char c = formula[at];
        if (c == '\\') {
            const std::string_view command = command_at(formula, at);
            depth += deeper_after(command);
            at += command.size() - 1;
        } else if (c == '{') {
            ++depth;
        } else if (c == '}') {
            --depth;
        } else if (depth == 0 &&
                   (formula.substr(at, 3) == " + " || formula.substr(at, 3) == " - ")) {
            terms.push_back(formula.substr(begin, at - begin));
            begin = at + 1;
        }
    }
    terms.push_back(formula.substr(begin));
    return terms;
}

/// The position after the group that begins with the `{` at `at`.
std::size_t end_of_group(std::string_view formula, std::size_t at) {
    int depth = 0;
    for (; at < formula.size(); ++at) {
        if (formula[at] == '\\') {
            at += command_at(formula, at).size() - 1;
        } else if (formula[at] == '{') {
            ++depth;
        } else if (formula[at] == '}' && --depth == 0) {
            return at;
        }
    }
    return at;
}

struct Fraction {
    std::string_view above, below;
};

/// The fraction, if the whole formula is a fraction; otherwise nullopt.
std::optional<Fraction> whole_fraction(std::string_view formula) {
    constexpr std::string_view command = "\\frac";
    if (!formula.starts_with("\\frac{")) return std::nullopt;
    const std::size_t middle = end_of_group(formula, command.size());
    if (middle + 2 >= formula.size()) return std::nullopt;
    if (end_of_group(formula, middle + 1) + 1 != formula.size()) return std::nullopt;
    return Fraction{formula.substr(command.size() + 1, middle - command.size() - 1),
                    formula.substr(middle + 2, formula.size() - middle - 3)};
}

}  // namespace

int width_in_signs(std::string_view formula) {
    int width = 0;
    for (std::size_t at = 0; at < formula.size(); ++at) {
        const char c = formula[at];
        if (c == '\\') {
            const std::string_view command = command_at(formula, at);
            const bool is_seen = is_letter(command.back()) && command != "\\left" &&
                                 command != "\\right" && command != "\\frac" &&
                                 command != "\\mathrm" && command != "\\operatorname";
            width += is_seen ? 1 : 0;
            at += command.size() - 1;
        } else if (c != '{' && c != '}' && c != '^' && c != '_' && c != ' ') {
            ++width;
        }
    }
    return width;
}

std::vector<std::string> broken_sum(std::string_view formula) {
    if (const auto fraction = whole_fraction(formula);
        fraction && width_in_signs(fraction->above) > signs_of_a_line) {
        std::vector<std::string> lines = broken_sum(fraction->above);
        lines.front().insert(0, "\\frac{1}{" + std::string(fraction->below) + "} \\Bigl( ");
        lines.back().append(" \\Bigr)");
        return lines;
    }
    std::vector<std::string> lines;
    for (const std::string_view term : terms_of(formula)) {
        const bool fits = !lines.empty() &&
                          width_in_signs(lines.back()) + width_in_signs(term) <= signs_of_a_line;
        if (fits) lines.back().append(" ").append(term);
        else lines.emplace_back(term);
    }
    return lines;
}

}  // namespace cascade
