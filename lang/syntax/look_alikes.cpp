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
    {U'\u2018', Kind::prime, "'"}, {U'\u2019', Kind::prime, "'"},
    {U'\u00b4', Kind::prime, "'"}, {U'\u02b9', Kind::prime, "'"}, {U'\uff07', Kind::prime, "'"},
    // Quotation marks.
    {U'\u201c', Kind::text, "\""}, {U'\u201d', Kind::text, "\""}, {U'\u201e', Kind::text, "\""},
    {U'\u00ab', Kind::text, "\""}, {U'\u00bb', Kind::text, "\""}, {U'\uff02', Kind::text, "\""},
    // Hyphens, dashes and the minus sign.
    {U'\u2010', Kind::minus, "-"}, {U'\u2011', Kind::minus, "-"}, {U'\u2012', Kind::minus, "-"},
    {U'\u2013', Kind::minus, "-"}, {U'\u2014', Kind::minus, "-"}, {U'\uff0d', Kind::minus, "-"},
    // Multiplication and division signs.
    {U'\u2217', Kind::star, "*"},  {U'\u2022', Kind::star, "*"},  {U'\uff0a', Kind::star, "*"},
    {U'\u00f7', Kind::slash, "/"}, {U'\u2044', Kind::slash, "/"}, {U'\u2215', Kind::slash, "/"},
    {U'\uff0f', Kind::slash, "/"}, {U'\uff0b', Kind::plus, "+"},  {U'\u02c6', Kind::caret, "^"},
    // Comparisons.
    {U'\uff1c', Kind::less, "<"},           {U'\uff1e', Kind::greater, ">"},
    // Full-width punctuation.
    {U'\uff08', Kind::open_round, "("},     {U'\uff09', Kind::close_round, ")"},
    {U'\uff3b', Kind::open_square, "["},    {U'\uff3d', Kind::close_square, "]"},
    {U'\uff5b', Kind::open_curly, "{"},     {U'\uff5d', Kind::close_curly, "}"},
    {U'\uff0c', Kind::comma, ","},          {U'\uff1a', Kind::colon, ":"},
    {U'\uff1b', Kind::semicolon, ";"},      {U'\uff1d', Kind::assign, "="},
    // Sums and products over indices.
    {U'\u2211', Kind::garbage, "sum(… over i)"},
    // Superscripts that are letters.
    {U'\u207f', Kind::garbage, "^n"},       {U'\u2071', Kind::garbage, "^i"},
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
    // Cyrillic letters that look like Latin ones.
    {U'а', "a"}, {U'е', "e"}, {U'о', "o"}, {U'р', "p"}, {U'с', "c"}, {U'у', "y"}, {U'х', "x"},
    {U'і', "i"}, {U'ѕ', "s"}, {U'ј', "j"},
    // Greek letters that look like Latin ones.
    {U'ο', "o"}, {U'Α', "A"}, {U'Β', "B"}, {U'Ε', "E"}, {U'Ζ', "Z"}, {U'Η', "H"}, {U'Ι', "I"},
    {U'Κ', "K"}, {U'Μ', "M"}, {U'Ν', "N"}, {U'Ο', "O"}, {U'Ρ', "P"}, {U'Τ', "T"}, {U'Υ', "Y"},
    {U'Χ', "X"}, {U'ς', "sigma"}, {U'\u212a', "K"}, {U'ℓ', "l"}, {U'ħ', "h"}, {U'ℏ', "h"},
    {U'ℎ', "h"},
};
// clang-format on

/// The Greek alphabet in the order of the mathematical styles, after the capitals.
constexpr std::string_view greek_of_styles[] = {"alpha",   "beta", "gamma", "delta", "epsilon",
                                                "zeta",    "eta",  "theta", "iota",  "kappa",
                                                "lambda",  "mu",   "nu",    "xi",    "o",
                                                "pi",      "rho",  "sigma", "sigma", "tau",
                                                "upsilon", "phi",  "chi",   "psi",   "omega"};

/// The spelling of a letter in one of Unicode's mathematical styles (U+1D400 to U+1D7CB), such as
/// the italic u of formulas copied from a PDF.
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
    const auto found = std::find_if(std::begin(letters), std::end(letters), [&](const Letter& row) {
        return row.code_point == code_point;
    });
    return found == std::end(letters) ? styled_spelling(code_point) : found->spelling;
}

}  // namespace cascade
