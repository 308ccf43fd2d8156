// Greek letters in names: each has one spelling in ASCII, and both spell the same name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The spelling of a Greek letter in names: `beta` for β. Forms of a letter that Unicode treats as
/// the same (µ U+00B5, ϵ, ϕ, ϑ, ϰ, ϱ, ϖ, Ω U+2126) have the spelling of that letter. Empty for all
/// other characters, for capital letters that resemble Latin ones, and for Δ, which is the
/// Laplacian.
std::string_view greek_spelling(char32_t code_point);

/// The digit '0' … '9' of a subscript digit ₀ … ₉. Empty for other characters.
std::optional<char> subscript_digit(char32_t code_point);

/// The letter of such a spelling in UTF-8: β for `beta`. Empty if there is none.
std::string_view greek_letter(std::string_view spelling);

/// A name with Greek letters for the words between its `_`, each of which may end in digits:
/// diff_α2 for `diff_alpha2`.
std::string with_greek_letters(std::string_view name);

/// A text with the ASCII spellings of all Greek letters and subscript digits. Other characters are
/// unchanged.
std::string with_ascii_names(std::string_view text);

/// Whether it is one of the digits 0 … 9.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The letter or digit of a name at the end of a text: its size in bytes, 0 if there is none.
std::size_t last_letter_of_name(std::string_view text);

}  // namespace cascade
