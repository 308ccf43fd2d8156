// Greek letters in names. Each letter has a spelling in ASCII. The letter and its spelling mean the
// same name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The ASCII spelling of a Greek letter in names: `beta` for β. Variants of a letter (µ U+00B5, ϵ,
/// ϕ, ϑ, ϰ, ϱ, ϖ, Ω U+2126) have the spelling of the letter. Empty for Greek capitals that look
/// like Latin letters, for Δ, which means the Laplacian, and for all other characters.
std::string_view greek_spelling(char32_t code_point);

/// The digit '0' … '9' that a subscript digit ₀ … ₉ means. Empty for other characters.
std::optional<char> subscript_digit(char32_t code_point);

/// The Greek letter with this ASCII spelling, in UTF-8: β for `beta`. Empty if no letter has this
/// spelling.
std::string_view greek_letter(std::string_view spelling);

/// Replaces ASCII spellings in a name by Greek letters. Only parts between `_` that are a whole
/// spelling, or a spelling followed by digits, are replaced: `diff_alpha2` becomes diff_α2.
std::string with_greek_letters(std::string_view name);

/// Replaces all Greek letters and subscript digits in a text by ASCII. Other characters are
/// unchanged.
std::string with_ascii_names(std::string_view text);

/// Whether the character is one of the digits 0 … 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The size in bytes of the last character of a text, if this character may be part of a name; else
/// 0.
std::size_t last_letter_of_name(std::string_view text);

}  // namespace cascade
