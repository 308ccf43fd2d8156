// The marks of functions in equations (internal to the printing of equations).
#pragma once

#include "lang/vocabulary/functions.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace cascade {

/// What surrounds the only operand of a call. In TeX brackets grow with their contents.
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

/// What stands between two operands.
struct Infix {
    Function function;
    std::string_view unicode, tex;
};
inline constexpr Infix infixes[] = {
    {Function::logical_or, " or ", " \\lor "},
    {Function::logical_and, " and ", " \\land "},
    {Function::less, " < ", " < "},
    {Function::less_equal, " ≤ ", " \\le "},
    {Function::greater, " > ", " > "},
    {Function::greater_equal, " ≥ ", " \\ge "},
    {Function::equal, " = ", " = "},
    {Function::not_equal, " ≠ ", " \\ne "},
    {Function::add, " + ", " + "},
    {Function::subtract, " − ", " - "},
    {Function::dot, " · ", " \\cdot "},
    {Function::cross, " × ", " \\times "},
};

/// What stands before the only operand of a call.
struct Prefix {
    std::string_view function, unicode, tex;
};
inline constexpr Prefix prefixes[] = {
    {"lap", "∇²", "\\nabla^2 "},
    {"grad", "∇", "\\nabla "},
    {"div", "∇·", "\\nabla \\cdot "},
    {"curl", "∇×", "\\nabla \\times "},
};

/// The row of a function; null if there is none.
template <typename Row, std::size_t count>
const Row* find(const Row (&rows)[count], decltype(Row::function) function) {
    const auto* const end = rows + count;
    const auto* const found =
        std::find_if(rows, end, [&](const Row& row) { return row.function == function; });
    return found == end ? nullptr : found;
}

}  // namespace cascade
