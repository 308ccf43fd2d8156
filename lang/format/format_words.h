// The words of a script (internal to the formatter): tokens and comments, with the blanks and line
// breaks between them.
#pragma once

#include "core/source.h"
#include "lang/syntax/token.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// A word: a comment, or a token that is not a line break.
struct FormatWord {
    /// The kind of the token. A comment has the kind `newline`.
    TokenKind kind = TokenKind::end_of_text;
    std::string_view text;  ///< The text as it will be written. Comments have no trailing blanks.
    std::string_view spelling;  ///< The token's spelling in ASCII. Empty for a comment.
    /// The number of blanks before the word, if the notation prescribes it.
    std::optional<std::size_t> gap;
    std::size_t breaks = 0;  ///< The number of line breaks between the previous word and this word.
    /// The number of columns between the previous word, or the start of the line, and this word.
    std::size_t blanks = 0;
    std::size_t column = 0;  ///< The word's column in the source, from 0.
    bool is_sign = false;    ///< A unary minus.
    bool is_spaced = false;  ///< An operator written with blanks around it.
    bool is_raised = false;  ///< A number written as a superscript.
    bool is_infix = false;   ///< A name between operands: over, in, step, after.

    bool is_comment() const { return kind == TokenKind::newline; }
};

/// The words of a script without lexical errors, in order. The end of the text is not included. If
/// the notation of papers omits a word, the word's text is empty.
std::vector<FormatWord> format_words(SourceId source, const Sources& sources);

/// The number of blanks between two words on a line: 0 or 1. Neither word may be a comment.
std::size_t blanks_between(const FormatWord& left, const FormatWord& right);

/// The width of a text in terminal columns.
std::size_t width_of(std::string_view text);

}  // namespace cascade
