// Characters that look like something of the language but are not: what a word processor or a
// web page makes of ' and -, signs of printed mathematics, and letters of other alphabets.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

/// A character outside ASCII that stands for a token.
struct LookAlike {
    char32_t code_point = 0;
    TokenKind meant = TokenKind::garbage;  ///< `newline` for a blank, `text` for a quotation mark.
    std::string_view write;                ///< What to write in its place.
};

/// The table's row of a code point; nullptr where there is none.
const LookAlike* find_look_alike(char32_t code_point);

/// What to write for a letter of another alphabet: `beta` for β, `a` for a Cyrillic а. Empty
/// where there is nothing.
std::string_view latin_spelling(char32_t code_point);

}  // namespace cascade
