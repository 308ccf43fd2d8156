// Characters that resemble characters of the language: typographic forms of ' and -, mathematical
// signs, and letters of other alphabets.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

/// A character outside of ASCII that was written in place of a token.
struct LookAlike {
    char32_t code_point = 0;
    TokenKind meant = TokenKind::garbage;  ///< The token that was probably meant. `newline` for a
                                           ///< blank, `text` for a quotation mark.
    std::string_view write;                ///< The text to write instead.
};

/// The row of the table for a code point; null if there is none.
const LookAlike* find_look_alike(char32_t code_point);

/// The letter to write in place of a letter that names cannot contain: `a` for a Cyrillic а, `u`
/// for a mathematical italic u. Empty if there is none.
std::string_view latin_spelling(char32_t code_point);

}  // namespace cascade
