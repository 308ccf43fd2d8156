// The spellings of operators and brackets, including those of other languages.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

struct Operator {
    std::string_view spelling;
    TokenKind kind;
};

/// A longer operator precedes its prefixes.
inline constexpr Operator operators[] = {
    {"=\u0338", TokenKind::not_equal},
    {"+=", TokenKind::plus_assign},
    {"==", TokenKind::equal},
    {"!=", TokenKind::not_equal},
    {"<=", TokenKind::less_equal},
    {">=", TokenKind::greater_equal},
    {"..", TokenKind::dots},
    {":", TokenKind::colon},
    {";", TokenKind::semicolon},
    {",", TokenKind::comma},
    {".", TokenKind::dot},
    {"'", TokenKind::prime},
    {"(", TokenKind::open_round},
    {")", TokenKind::close_round},
    {"[", TokenKind::open_square},
    {"]", TokenKind::close_square},
    {"{", TokenKind::open_curly},
    {"}", TokenKind::close_curly},
    {"=", TokenKind::assign},
    {"<", TokenKind::less},
    {">", TokenKind::greater},
    {"+", TokenKind::plus},
    {"-", TokenKind::minus},
    {"*", TokenKind::star},
    {"/", TokenKind::slash},
    {"^", TokenKind::caret},
    // Signs of papers. Unicode treats a '=' with a combining stroke and the Greek semicolon as
    // equal to ≠ and ·.
    {"≤", TokenKind::less_equal},
    {"≥", TokenKind::greater_equal},
    {"≠", TokenKind::not_equal},
    {"·", TokenKind::star},
    {"⋅", TokenKind::star},
    {"\u0387", TokenKind::star},
    {"×", TokenKind::star},
    {"−", TokenKind::minus},
    {"′", TokenKind::prime},
    {"∧", TokenKind::keyword_and},
    {"∨", TokenKind::keyword_or},
    {"¬", TokenKind::keyword_not},
    {"∇", TokenKind::nabla},
    {"Δ", TokenKind::laplacian},
    {"∆", TokenKind::laplacian},
    {"∂", TokenKind::partial},
    {"√", TokenKind::root},
    {"|", TokenKind::bar},
    {"∣", TokenKind::bar},
};

/// Operators of other languages, and their equivalents.
struct ForeignOperator {
    std::string_view spelling;
    TokenKind meant;
    std::string_view hint;
};

inline constexpr ForeignOperator foreign_operators[] = {
    {"===", TokenKind::equal, "write '=='"},
    {"!==", TokenKind::not_equal, "write '!='"},
    {"**", TokenKind::caret, "write '^' for a power"},
    {"&&", TokenKind::keyword_and, "write 'and'"},
    {"<>", TokenKind::not_equal, "write '!='"},
    {"=>", TokenKind::greater_equal, "write '>='"},
    {"=<", TokenKind::less_equal, "write '<='"},
    {":=", TokenKind::colon, "write ':' for a value, '=' for a definition"},
    {"-=", TokenKind::plus_assign, "write '+=' and a minus sign before the term"},
    {"*=", TokenKind::plus_assign, "there is only '+='"},
    {"/=", TokenKind::plus_assign, "there is only '+='"},
    {"&", TokenKind::keyword_and, "write 'and'"},
    {"%", TokenKind::garbage, "write mod(a, b) for a % b"},
};

/// Tried only if no operator of the language matches, since `!=` is one.
inline constexpr ForeignOperator foreign_not = {"!", TokenKind::keyword_not, "write 'not'"};

}  // namespace cascade
