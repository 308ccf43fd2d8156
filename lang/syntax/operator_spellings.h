// Spellings of operators and brackets, including the spellings of other languages.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

struct Operator {
    std::string_view spelling;
    TokenKind kind;
};

/// The spellings of operators and brackets. If one spelling begins with another, the longer one
/// comes first.
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
    // Signs of papers. Two spellings are unusual: Unicode treats a '=' with a combining stroke as
    // equal to ≠, and the Greek semicolon as equal to ·.
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

/// An operator of another language, and the token that it probably means.
struct ForeignOperator {
    std::string_view spelling;
    TokenKind meant;
    std::string_view hint;
};

inline constexpr ForeignOperator foreign_operators[] = {
    {"===", TokenKind::equal, "write '=='"},
    {"!==", TokenKind::not_equal, "write '!='"},
    {"**", TokenKind::caret, "write '^' for a power"},
    {".*", TokenKind::star, "write '*'"},
    {"./", TokenKind::slash, "write '/'"},
    {".^", TokenKind::caret, "write '^'"},
    {"->", TokenKind::garbage, "a reaction is given by rates: u' = …"},
    {"→", TokenKind::garbage, "a reaction is given by rates: u' = …"},
    {"&&", TokenKind::keyword_and, "write 'and'"},
    {"<>", TokenKind::not_equal, "write '!='"},
    {"=>", TokenKind::greater_equal, "write '>='"},
    {"=<", TokenKind::less_equal, "write '<='"},
    {":=", TokenKind::colon, "write ':' for a value, '=' for a definition"},
    {"-=", TokenKind::plus_assign, "write '+=' and a minus sign before the term"},
    {"*=", TokenKind::plus_assign, "there is only '+='"},
    {"/=", TokenKind::plus_assign, "there is only '+='"},
    {"&", TokenKind::keyword_and, "write 'and'"},
    {"%", TokenKind::garbage, "write mod(a, b) for a % b, 0.05 for 5 %; '#' begins a comment"},
};

/// The operator `!` of other languages. It is tried only if no operator of Cascade matches, because
/// `!=` begins with `!`.
inline constexpr ForeignOperator foreign_not = {"!", TokenKind::keyword_not, "write 'not'"};

}  // namespace cascade
