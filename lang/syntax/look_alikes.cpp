// The tables of characters that resemble characters of the language.
#include "lang/syntax/look_alikes.h"

#include <algorithm>
#include <iterator>

namespace cascade {

namespace {

/// The token that the author probably intended.
using Meant = TokenKind;

// clang-format off
constexpr LookAlike look_alikes[] = {
    // Primes: typographic quotation marks, accents, and the mathematical prime.
    {U'\u2018', Meant::prime, "'"}, {U'\u2019', Meant::prime, "'"},
    {U'\u00b4', Meant::prime, "'"}, {U'\u02b9', Meant::prime, "'"}, {U'\uff07', Meant::prime, "'"},
    // Quotation marks.
    {U'\u201c', Meant::text, "\""}, {U'\u201d', Meant::text, "\""}, {U'\u201e', Meant::text, "\""},
    {U'\u00ab', Meant::text, "\""}, {U'\u00bb', Meant::text, "\""}, {U'\uff02', Meant::text, "\""},
    // Hyphens, dashes and the minus sign.
    {U'\u2010', Meant::minus, "-"}, {U'\u2011', Meant::minus, "-"}, {U'\u2012', Meant::minus, "-"},
    {U'\u2013', Meant::minus, "-"}, {U'\u2014', Meant::minus, "-"}, {U'\uff0d', Meant::minus, "-"},
    // Multiplication and division signs.
    {U'\u2217', Meant::star, "*"},  {U'\u2022', Meant::star, "*"},  {U'\uff0a', Meant::star, "*"},
    {U'\u00f7', Meant::slash, "/"}, {U'\u2044', Meant::slash, "/"}, {U'\u2215', Meant::slash, "/"},
    {U'\uff0f', Meant::slash, "/"}, {U'\uff0b', Meant::plus, "+"},  {U'\u02c6', Meant::caret, "^"},
    // Comparisons.
    {U'\uff1c', Meant::less, "<"},           {U'\uff1e', Meant::greater, ">"},
    // Full-width punctuation.
    {U'\uff08', Meant::open_round, "("},     {U'\uff09', Meant::close_round, ")"},
    {U'\uff3b', Meant::open_square, "["},    {U'\uff3d', Meant::close_square, "]"},
    {U'\uff5b', Meant::open_curly, "{"},     {U'\uff5d', Meant::close_curly, "}"},
    {U'\uff0c', Meant::comma, ","},          {U'\uff1a', Meant::colon, ":"},
    {U'\uff1b', Meant::semicolon, ";"},      {U'\uff1d', Meant::assign, "="},
    // The signs of sums and products over indices.
    {U'\u2211', Meant::garbage, "sum(… over i)"},
    {U'\u222b', Meant::garbage, "integral(… over domain)"},
    // The sign ± between a value and its deviation.
    {U'\u00b1', Meant::plus, "random(m, s)"},
    // Superscript letters.
    {U'\u207f', Meant::garbage, "^n"},       {U'\u2071', Meant::garbage, "^i"},
    // Blanks.
    {U'\u00a0', Meant::newline, " "}, {U'\u2002', Meant::newline, " "},
    {U'\u2003', Meant::newline, " "}, {U'\u2007', Meant::newline, " "},
    {U'\u2009', Meant::newline, " "}, {U'\u200a', Meant::newline, " "},
    {U'\u200b', Meant::newline, " "}, {U'\u202f', Meant::newline, " "},
    {U'\u205f', Meant::newline, " "}, {U'\u3000', Meant::newline, " "},
    {U'\ufeff', Meant::newline, " "},
};
// clang-format on

struct LatinLookAlike {
    char32_t code_point;
    std::string_view spelling;
};

// clang-format off
constexpr LatinLookAlike latin_look_alikes[] = {
    // Cyrillic letters that look like Latin letters.
    {U'а', "a"}, {U'е', "e"}, {U'о', "o"}, {U'р', "p"}, {U'с', "c"}, {U'у', "y"}, {U'х', "x"},
    {U'і', "i"}, {U'ѕ', "s"}, {U'ј', "j"},
    // Greek letters that look like Latin letters.
    {U'ο', "o"}, {U'Α', "A"}, {U'Β', "B"}, {U'Ε', "E"}, {U'Ζ', "Z"}, {U'Η', "H"}, {U'Ι', "I"},
    {U'Κ', "K"}, {U'Μ', "M"}, {U'Ν', "N"}, {U'Ο', "O"}, {U'Ρ', "P"}, {U'Τ', "T"}, {U'Υ', "Y"},
    {U'Χ', "X"}, {U'ς', "sigma"}, {U'\u212a', "K"}, {U'ℓ', "l"}, {U'ħ', "h"}, {U'ℏ', "h"},
    {U'ℎ', "h"},
};
// clang-format on

/// The lower-case Greek letters, in the order that they have in each of Unicode's mathematical
/// styles. In each style, these letters follow the capitals.
constexpr std::string_view greek_of_styles[] = {"alpha",   "beta", "gamma", "delta", "epsilon",
                                                "zeta",    "eta",  "theta", "iota",  "kappa",
                                                "lambda",  "mu",   "nu",    "xi",    "o",
                                                "pi",      "rho",  "sigma", "sigma", "tau",
                                                "upsilon", "phi",  "chi",   "psi",   "omega"};

/// The spelling of a letter in one of Unicode's mathematical styles (U+1D400 to U+1D7CB), such as
/// the italic u in formulas copied from a PDF.
std::string_view styled_spelling(char32_t code_point) {
    static constexpr std::string_view latin =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    constexpr char32_t first_latin = 0x1d400, last_latin = 0x1d6a3;
    constexpr char32_t first_greek = 0x1d6a8, last_greek = 0x1d7cb, greek_size = 58, capitals = 26;
    if (code_point >= first_latin && code_point <= last_latin) {
        return latin.substr((code_point - first_latin) % latin.size(), 1);
    }
    if (code_point < first_greek || code_point > last_greek) return {};
    const std::size_t letter = (code_point - first_greek) % greek_size;
    if (letter < capitals || letter - capitals >= std::size(greek_of_styles)) return {};
    return greek_of_styles[letter - capitals];
}

}  // namespace

const LookAlike* find_look_alike(char32_t code_point) {
    const auto found =
        std::find_if(std::begin(look_alikes), std::end(look_alikes),
                     [&](const LookAlike& row) { return row.code_point == code_point; });
    return found == std::end(look_alikes) ? nullptr : &*found;
}

std::string_view latin_spelling(char32_t code_point) {
    const auto found =
        std::find_if(std::begin(latin_look_alikes), std::end(latin_look_alikes),
                     [&](const LatinLookAlike& row) { return row.code_point == code_point; });
    return found == std::end(latin_look_alikes) ? styled_spelling(code_point) : found->spelling;
}

}  // namespace cascade
