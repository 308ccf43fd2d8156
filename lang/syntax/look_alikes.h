// Characters that resemble those of the language: typographic forms of ' and -, mathematical signs,
// and letters of other alphabets.
#pragma once

#include "lang/syntax/token.h"

#include <string_view>

namespace cascade {

/// A non-ASCII character in place of a token.
struct LookAlike {
    char32_t code_point = 0;
    TokenKind meant = TokenKind::garbage;  ///< `newline` for a blank, `text` for a quotation mark.
    std::string_view write;                ///< The text to write instead.
};

/// The table's row for a code point. Null if there is none.
const LookAlike* find_look_alike(char32_t code_point);

/// The text to write for a letter that no name has: `a` for a Cyrillic а, `u` for a mathematical
/// italic u. Empty if there is none.
std::string_view latin_spelling(char32_t code_point);

}  // namespace cascade
