// The table of Greek letters.
#include "lang/vocabulary/greek_letters.h"

#include "core/utf8.h"

#include <algorithm>
#include <iterator>

namespace cascade {

namespace {

struct GreekLetter {
    char32_t code_point;
    std::string_view letter, spelling;
};

/// If several letters have the same ASCII spelling, the first letter in the table replaces the
/// spelling.
// clang-format off
constexpr GreekLetter greek_letters[] = {
    {U'α', "α", "alpha"},  {U'β', "β", "beta"},   {U'γ', "γ", "gamma"},   {U'δ', "δ", "delta"},
    {U'ε', "ε", "epsilon"}, {U'ζ', "ζ", "zeta"},  {U'η', "η", "eta"},     {U'θ', "θ", "theta"},
    {U'ι', "ι", "iota"},   {U'κ', "κ", "kappa"},  {U'λ', "λ", "lambda"},  {U'μ', "μ", "mu"},
    {U'ν', "ν", "nu"},     {U'ξ', "ξ", "xi"},     {U'π', "π", "pi"},      {U'ρ', "ρ", "rho"},
    {U'σ', "σ", "sigma"},  {U'τ', "τ", "tau"},    {U'υ', "υ", "upsilon"}, {U'φ', "φ", "phi"},
    {U'χ', "χ", "chi"},    {U'ψ', "ψ", "psi"},    {U'ω', "ω", "omega"},
    {U'Γ', "Γ", "Gamma"},  {U'Θ', "Θ", "Theta"},  {U'Λ', "Λ", "Lambda"},  {U'Ξ', "Ξ", "Xi"},
    {U'Π', "Π", "Pi"},     {U'Σ', "Σ", "Sigma"},  {U'Φ', "Φ", "Phi"},     {U'Ψ', "Ψ", "Psi"},
    {U'Ω', "Ω", "Omega"},
    // Unicode defines each of these characters as equivalent to a letter above, either canonically
    // or by compatibility.
    {U'\u00b5', "µ", "mu"},    {U'\u2126', "Ω", "Omega"}, {U'\u03f5', "ϵ", "epsilon"},
    {U'\u03d5', "ϕ", "phi"},   {U'\u03d1', "ϑ", "theta"}, {U'\u03f0', "ϰ", "kappa"},
    {U'\u03f1', "ϱ", "rho"},   {U'\u03d6', "ϖ", "pi"},    {U'\u1fbe', "ι", "iota"},
};
// clang-format on

}  // namespace

std::string_view greek_spelling(char32_t code_point) {
    if (code_point < 0x80) return {};
    const auto* const found =
        std::find_if(std::begin(greek_letters), std::end(greek_letters),
                     [&](const GreekLetter& row) { return row.code_point == code_point; });
    return found == std::end(greek_letters) ? std::string_view() : found->spelling;
}

std::string_view greek_letter(std::string_view spelling) {
    const auto* const found =
        std::find_if(std::begin(greek_letters), std::end(greek_letters),
                     [&](const GreekLetter& row) { return row.spelling == spelling; });
    return found == std::end(greek_letters) ? std::string_view() : found->letter;
}

std::string with_greek_letters(std::string_view name) {
    std::string written;
    while (true) {
        const std::size_t bar = std::min(name.find('_'), name.size());
        const std::string_view word = name.substr(0, bar);
        std::size_t digits = word.size();
        while (digits > 0 && is_digit(word[digits - 1])) --digits;
        const std::string_view letter = greek_letter(word.substr(0, digits));
        written += letter.empty() ? word : std::string(letter) + std::string(word.substr(digits));
        if (bar == name.size()) return written;
        written += '_';
        name.remove_prefix(bar + 1);
    }
}

std::optional<char> subscript_digit(char32_t code_point) {
    if (code_point < U'₀' || code_point > U'₉') return std::nullopt;
    return static_cast<char>('0' + static_cast<char>(code_point - U'₀'));
}

std::string with_ascii_names(std::string_view text) {
    std::string result;
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        const std::string_view spelling = greek_spelling(point.value);
        if (!spelling.empty()) result += spelling;
        else if (const auto digit = subscript_digit(point.value)) result += *digit;
        else result += text.substr(offset, point.size);
        offset += point.size;
    }
    return result;
}

std::size_t last_letter_of_name(std::string_view text) {
    if (text.empty()) return 0;
    const char last = text.back();
    const bool is_letter = (last >= 'a' && last <= 'z') || (last >= 'A' && last <= 'Z');
    if (is_letter || is_digit(last) || last == '_') return 1;
    constexpr std::size_t longest = 3;
    for (std::size_t size = 2; size <= std::min(longest, text.size()); ++size) {
        const CodePoint point = decode_utf8(text, text.size() - size);
        const bool is_whole = point.valid && point.size == size;
        const bool is_of_name =
            !greek_spelling(point.value).empty() || subscript_digit(point.value).has_value();
        if (is_whole && is_of_name) return size;
    }
    return 0;
}

}  // namespace cascade
