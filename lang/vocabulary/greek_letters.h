// Greek letters in names. Each has a spelling in ASCII, and both forms mean the same name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The ASCII spelling of a Greek letter in names: `beta` for β. Variants of a letter (µ U+00B5, ϵ,
/// ϕ, ϑ, ϰ, ϱ, ϖ, Ω U+2126) have the spelling of the letter. Empty for all other characters, for
/// capital letters that resemble Latin ones, and for Δ, which is the Laplacian.
std::string_view greek_spelling(char32_t code_point);

/// The digit '0' … '9' for a subscript digit ₀ … ₉. Empty for other characters.
std::optional<char> subscript_digit(char32_t code_point);

/// The Greek letter with this ASCII spelling, in UTF-8: β for `beta`. Empty if there is none.
std::string_view greek_letter(std::string_view spelling);

/// The name with Greek letters in place of their spellings. A spelling must be a whole part of the
/// name between `_`, but digits may follow it: diff_α2 for `diff_alpha2`.
std::string with_greek_letters(std::string_view name);

/// The text with ASCII spellings in place of all Greek letters and subscript digits. Other
/// characters are unchanged.
std::string with_ascii_names(std::string_view text);

/// Whether the character is one of the digits 0 … 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The size in bytes of the last character of a text, if names may contain it; else 0.
std::size_t last_letter_of_name(std::string_view text);

}  // namespace cascade
