// The words of a script as the formatter sees them: tokens and comments, with what was between
// them.
//
// Internal to the formatter.
#pragma once

#include "core/source.h"
#include "lang/syntax/token.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace cascade {

/// A token other than a line end, or a comment.
struct FormatWord {
    TokenKind kind = TokenKind::end_of_text;  ///< Of a comment: newline.
    std::string_view text;                    ///< A comment's is without blanks at its end.
    std::size_t breaks = 0;                   ///< Line ends between the word before and this one.
    std::size_t blanks = 0;  ///< Columns between the word before, or the line's start, and it.
    std::size_t column = 0;  ///< Where it stood on its line, from 0.
    bool is_sign = false;    ///< A minus that stands before its operand.
    bool is_spaced = false;  ///< An operator of the author's choice: with blanks around it.
    bool is_infix = false;   ///< A name that stands between operands: over, in, step.

    bool is_comment() const { return kind == TokenKind::newline; }
};

/// The words of a script that can be read, in order, without the end of the text.
std::vector<FormatWord> format_words(SourceId source, const Sources& sources);

/// Blanks between two words on a line: 0 or 1. Neither is a comment.
std::size_t blanks_between(const FormatWord& left, const FormatWord& right);

/// Terminal columns of a text.
std::size_t width_of(std::string_view text);

}  // namespace cascade
