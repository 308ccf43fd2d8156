// Recognises comments and numbers as other languages write them, for messages of the lexer.
#pragma once

#include "lang/syntax/token.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// Whether a comment of another language begins at `offset`: `//`, `/*`, or `--` between blanks.
bool begins_foreign_comment(std::string_view text, std::size_t offset);

/// What is wrong with digits and the letters directly after them, such as 2d, which are not a
/// number.
struct NumberFault {
    std::string message, hint;
    std::size_t end = 0;  ///< Where the wrong text ends.
};

/// Describes what is wrong with the digits [begin, number_end) of `text` and the letters after
/// them. `before` are the tokens before the digits.
NumberFault fault_of_number(std::span<const Token> before, std::string_view text, std::size_t begin,
                            std::size_t number_end, std::size_t end);

}  // namespace cascade
