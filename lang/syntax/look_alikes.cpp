// The tables of look-alikes.
#include "lang/syntax/look_alikes.h"

#include <algorithm>
#include <iterator>

namespace cascade {

namespace {

using Kind = TokenKind;

// clang-format off
constexpr LookAlike look_alikes[] = {
    // Primes: typographic quotation marks, accents, the mathematical prime.
    {U'\u2018', Kind::prime, "'"}, {U'\u2019', Kind::prime, "'"}, {U'\u2032', Kind::prime, "'"},
    {U'\u00b4', Kind::prime, "'"}, {U'\u02b9', Kind::prime, "'"}, {U'\uff07', Kind::prime, "'"},
    // Quotation marks.
    {U'\u201c', Kind::text, "\""}, {U'\u201d', Kind::text, "\""}, {U'\u201e', Kind::text, "\""},
    {U'\u00ab', Kind::text, "\""}, {U'\u00bb', Kind::text, "\""}, {U'\uff02', Kind::text, "\""},
    // Hyphens, dashes and the minus sign.
    {U'\u2010', Kind::minus, "-"}, {U'\u2011', Kind::minus, "-"}, {U'\u2012', Kind::minus, "-"},
    {U'\u2013', Kind::minus, "-"}, {U'\u2014', Kind::minus, "-"}, {U'\u2212', Kind::minus, "-"},
    {U'\uff0d', Kind::minus, "-"},
    // Multiplication and division signs.
    {U'\u00d7', Kind::star, "*"},  {U'\u00b7', Kind::star, "*"},  {U'\u2217', Kind::star, "*"},
    {U'\u22c5', Kind::star, "*"},  {U'\u2022', Kind::star, "*"},  {U'\uff0a', Kind::star, "*"},
    {U'\u00f7', Kind::slash, "/"}, {U'\u2044', Kind::slash, "/"}, {U'\u2215', Kind::slash, "/"},
    {U'\uff0f', Kind::slash, "/"}, {U'\uff0b', Kind::plus, "+"},  {U'\u02c6', Kind::caret, "^"},
    // Comparisons and logic.
    {U'\u2264', Kind::less_equal, "<="},    {U'\u2265', Kind::greater_equal, ">="},
    {U'\u2260', Kind::not_equal, "!="},     {U'\uff1c', Kind::less, "<"},
    {U'\uff1e', Kind::greater, ">"},        {U'\u2227', Kind::keyword_and, "and"},
    {U'\u2228', Kind::keyword_or, "or"},    {U'\u00ac', Kind::keyword_not, "not"},
    // Full-width punctuation.
    {U'\uff08', Kind::open_round, "("},     {U'\uff09', Kind::close_round, ")"},
    {U'\uff3b', Kind::open_square, "["},    {U'\uff3d', Kind::close_square, "]"},
    {U'\uff5b', Kind::open_curly, "{"},     {U'\uff5d', Kind::close_curly, "}"},
    {U'\uff0c', Kind::comma, ","},          {U'\uff1a', Kind::colon, ":"},
    {U'\uff1b', Kind::semicolon, ";"},      {U'\uff1d', Kind::assign, "="},
    // Superscripts.
    {U'\u00b2', Kind::garbage, "^2"},       {U'\u00b3', Kind::garbage, "^3"},
    // Blanks.
    {U'\u00a0', Kind::newline, " "}, {U'\u2002', Kind::newline, " "},
    {U'\u2003', Kind::newline, " "}, {U'\u2007', Kind::newline, " "},
    {U'\u2009', Kind::newline, " "}, {U'\u200a', Kind::newline, " "},
    {U'\u200b', Kind::newline, " "}, {U'\u202f', Kind::newline, " "},
    {U'\u205f', Kind::newline, " "}, {U'\u3000', Kind::newline, " "},
    {U'\ufeff', Kind::newline, " "},
};
// clang-format on

struct Letter {
    char32_t code_point;
    std::string_view spelling;
};

// clang-format off
constexpr Letter letters[] = {
    {U'α', "alpha"},  {U'β', "beta"},    {U'γ', "gamma"}, {U'δ', "delta"},  {U'ε', "epsilon"},
    {U'ζ', "zeta"},   {U'η', "eta"},     {U'θ', "theta"}, {U'κ', "kappa"},  {U'λ', "lambda"},
    {U'μ', "mu"},     {U'µ', "mu"},      {U'ν', "nu"},    {U'ξ', "xi"},     {U'π', "pi"},
    {U'ρ', "rho"},    {U'σ', "sigma"},   {U'τ', "tau"},   {U'φ', "phi"},    {U'χ', "chi"},
    {U'ψ', "psi"},    {U'ω', "omega"},   {U'∆', "lap"},   {U'Δ', "lap"},    {U'∇', "grad"},
    // Cyrillic letters that look like Latin ones.
    {U'а', "a"}, {U'е', "e"}, {U'о', "o"}, {U'р', "p"}, {U'с', "c"}, {U'у', "y"}, {U'х', "x"},
    {U'і', "i"}, {U'ѕ', "s"}, {U'ј', "j"},
};
// clang-format on

}  // namespace

const LookAlike* find_look_alike(char32_t code_point) {
    const auto found =
        std::find_if(std::begin(look_alikes), std::end(look_alikes),
                     [&](const LookAlike& row) { return row.code_point == code_point; });
    return found == std::end(look_alikes) ? nullptr : &*found;
}

std::string_view latin_spelling(char32_t code_point) {
    const auto found = std::find_if(std::begin(letters), std::end(letters), [&](const Letter& row) {
        return row.code_point == code_point;
    });
    return found == std::end(letters) ? std::string_view() : found->spelling;
}

}  // namespace cascade
