// The words of a script for the formatter (internal): tokens and comments, with the blanks and line
// breaks between them.
#pragma once

#include "core/source.h"
#include "lang/syntax/token.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// A token other than a line end, or a comment.
struct FormatWord {
    TokenKind kind = TokenKind::end_of_text;  ///< `newline` for a comment.
    std::string_view text;           ///< As written. For a comment without trailing blanks.
    std::string_view spelling;       ///< The token's spelling in ASCII. Empty for a comment.
    std::optional<std::size_t> gap;  ///< Blanks before it, if its notation fixes them.
    std::size_t breaks = 0;          ///< Line breaks between the previous word and this one.
    std::size_t blanks = 0;          ///< Columns after the previous word or the line start.
    std::size_t column = 0;          ///< Its column in the source, from 0.
    bool is_sign = false;            ///< A unary minus.
    bool is_spaced = false;          ///< An operator written with blanks around it.
    bool is_raised = false;          ///< A number written as a superscript.
    bool is_infix = false;           ///< A name between operands: over, in, step, after.

    bool is_comment() const { return kind == TokenKind::newline; }
};

/// The words of a script without lexical errors, in order, without the end of the text. Words
/// omitted by the notation of papers have no text.
std::vector<FormatWord> format_words(SourceId source, const Sources& sources);

/// The number of blanks between two words on a line: 0 or 1. Neither is a comment.
std::size_t blanks_between(const FormatWord& left, const FormatWord& right);

/// Width of a text in terminal columns.
std::size_t width_of(std::string_view text);

}  // namespace cascade
