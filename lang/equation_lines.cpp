#include "lang/equation_lines.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace cascade {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// The command that begins at a backslash: `\frac`, `\,`.
std::string_view command_at(std::string_view formula, std::size_t at) {
    std::size_t end = at + 1;
    while (end < formula.size() && is_letter(formula[end])) ++end;
    return formula.substr(at, std::max(end, at + 2) - at);
}

/// How much deeper in brackets, groups or environments a formula is behind a command.
int deeper_behind(std::string_view command) {
    if (command == "\\left" || command == "\\begin" || command == "\\lfloor" || command == "\\lceil") {
        return 1;
    }
    const bool closes = command == "\\right" || command == "\\end" || command == "\\rfloor" ||
                        command == "\\rceil";
    return closes ? -1 : 0;
}

/// The terms of a sum, all but the first with their sign in front.
std::vector<std::string_view> terms_of(std::string_view formula) {
    std::vector<std::string_view> terms;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t at = 0; at < formula.size(); ++at) {
        const char c = formula[at];
        if (c == '\\') {
            const std::string_view command = command_at(formula, at);
            depth += deeper_behind(command);
            at += command.size() - 1;
        } else if (c == '{') {
            ++depth;
        } else if (c == '}') {
            --depth;
        } else if (depth == 0 && (formula.substr(at, 3) == " + " || formula.substr(at, 3) == " - ")) {
            terms.push_back(formula.substr(begin, at - begin));
            begin = at + 1;
        }
    }
    terms.push_back(formula.substr(begin));
    return terms;
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
    std::vector<std::string> lines;
    for (const std::string_view term : terms_of(formula)) {
        const bool fits = !lines.empty() && width_in_signs(lines.back()) + width_in_signs(term) <=
                                                signs_of_a_line;
        if (fits) lines.back().append(" ").append(term);
        else lines.emplace_back(term);
    }
    return lines;
}

}  // namespace cascade
