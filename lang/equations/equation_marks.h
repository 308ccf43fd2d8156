// The marks of functions in equations (internal to printing equations).
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace cascade {

/// The marks around the operand of a call that has one operand. In TeX, brackets grow with their
/// contents.
struct Around {
    std::string_view function, unicode_open, unicode_close, tex_open, tex_close;
};
inline constexpr Around arounds[] = {
    {"abs", "|", "|", "\\left|", "\\right|"},
    {"length", "|", "|", "\\left|", "\\right|"},
    {"floor", "⌊", "⌋", "\\lfloor ", " \\rfloor "},
    {"ceil", "⌈", "⌉", "\\lceil ", " \\rceil "},
    {"log", "ln(", ")", "\\ln\\left(", "\\right)"},
    {"exp", "exp(", ")", "\\exp\\left(", "\\right)"},
    {"sin", "sin(", ")", "\\sin\\left(", "\\right)"},
    {"cos", "cos(", ")", "\\cos\\left(", "\\right)"},
    {"tan", "tan(", ")", "\\tan\\left(", "\\right)"},
    {"sinh", "sinh(", ")", "\\sinh\\left(", "\\right)"},
    {"cosh", "cosh(", ")", "\\cosh\\left(", "\\right)"},
    {"tanh", "tanh(", ")", "\\tanh\\left(", "\\right)"},
};

/// The mark between the two operands of a call.
struct Infix {
    std::string_view function, unicode, tex;
};
inline constexpr Infix infixes[] = {
    {"or", " or ", " \\lor "}, {"and", " and ", " \\land "}, {"<", " < ", " < "},
    {"<=", " ≤ ", " \\le "},   {">", " > ", " > "},          {">=", " ≥ ", " \\ge "},
    {"==", " = ", " = "},      {"!=", " ≠ ", " \\ne "},      {"+", " + ", " + "},
    {"-", " − ", " - "},       {"dot", " · ", " \\cdot "},   {"cross", " × ", " \\times "},
};

/// The mark before the operand of a call that has one operand.
struct Prefix {
    std::string_view function, unicode, tex;
};
inline constexpr Prefix prefixes[] = {
    {"lap", "∇²", "\\nabla^2 "},
    {"grad", "∇", "\\nabla "},
    {"div", "∇·", "\\nabla \\cdot "},
    {"curl", "∇×", "\\nabla \\times "},
};

/// The row for the function with this spelling; null if there is none.
template <typename Row, std::size_t count>
const Row* find(const Row (&rows)[count], std::string_view function) {
    const auto* const end = rows + count;
    const auto* const found =
        std::find_if(rows, end, [&](const Row& row) { return row.function == function; });
    return found == end ? nullptr : found;
}

}  // namespace cascade
