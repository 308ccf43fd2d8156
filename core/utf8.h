// UTF-8: reading code points one by one, and how wide they are on a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade {

/// A decoded code point. An invalid byte is `valid == false`, its own value, and of size 1.
struct CodePoint {
    char32_t value = 0;
    std::uint32_t size = 1;  ///< Bytes it takes in the text.
    bool valid = true;
};

/// What stands for what is no text: U+FFFD.
inline constexpr std::string_view replacement_character = "\xef\xbf\xbd";

/// The code point at `offset`, which must be inside the text. Overlong forms, surrogates and values
/// above U+10FFFF are invalid (RFC 3629).
CodePoint decode_utf8(std::string_view text, std::size_t offset);

/// How many code points a text has; an invalid byte counts as one.
std::size_t count_code_points(std::string_view text);

/// Terminal columns of a printable code point: 0 for combining marks, 2 for wide letters, else 1.
int display_width(char32_t code_point);

/// True for what must not reach a terminal as it is: control characters, and the invisible ones
/// that change the direction or the look of the text around them.
bool is_unprintable(char32_t code_point);

}  // namespace cascade
