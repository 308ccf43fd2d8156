// UTF-8: decoding code points, and their width on a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade {

/// A decoded code point. An invalid byte has `valid == false`, its own value, and size 1.
struct CodePoint {
    char32_t value = 0;
    std::uint32_t size = 1;  ///< Number of bytes in the text.
    bool valid = true;
};

/// U+FFFD, which replaces invalid text.
inline constexpr std::string_view replacement_character = "\xef\xbf\xbd";

/// The code point at `offset`, which must be inside the text. Overlong forms, surrogates and values
/// above U+10FFFF are invalid (RFC 3629).
CodePoint decode_utf8(std::string_view text, std::size_t offset);

/// The number of code points in a text. An invalid byte counts as one.
std::size_t count_code_points(std::string_view text);

/// The number of UTF-16 units of a text, in which JavaScript and editors count columns: two for
/// code points above U+FFFF, else one.
std::size_t count_utf16_units(std::string_view text);

/// Terminal columns of a printable code point: 0 for combining marks, 2 for wide letters, else 1.
int display_width(char32_t code_point);

/// Whether a code point must not reach a terminal unchanged: control characters, and invisible
/// characters that change the direction or appearance of the text around them.
bool is_unprintable(char32_t code_point);

}  // namespace cascade
