// Characters that resemble characters of the language: typographic forms of ' and -, mathematical
// signs, and letters of other alphabets.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

/// A character outside of ASCII that was written in place of a token, and the token.
struct LookAlike {
    char32_t code_point = 0;
    /// The token that was probably meant. `newline` for a blank, `text` for a quotation mark.
    TokenKind meant = TokenKind::garbage;
    std::string_view write;  ///< The text that should be written.
};

/// The row of the table for a code point; null if there is none.
const LookAlike* find_look_alike(char32_t code_point);

/// The letter to write in place of a letter that names cannot contain: `a` for a Cyrillic а, `u`
/// for a mathematical italic u. Empty if there is no such letter.
std::string_view latin_spelling(char32_t code_point);

}  // namespace cascade
