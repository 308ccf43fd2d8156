// Divides a formatted script into lines, and sets the columns of words (internal to the formatter).
#pragma once

#include "lang/format/format_words.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct FormatLine {
    /// The position of a word that is not a comment.
    struct Cell {
        std::size_t word = 0;
        std::size_t column = 0;
    };
    std::vector<Cell> cells;
    std::optional<std::size_t> comment;  ///< The comment after the cells, or alone on the line.
    std::size_t comment_column = 0;
    std::size_t indentation = 0;  ///< The line's first column. Not set if `goes_on`.
    bool goes_on = false;         ///< Whether the line continues an earlier line's statement.
    bool blank_line_before = false;
};

/// Splits words into lines. Sets the indentation of each line, but no other columns.
std::vector<FormatLine> format_lines(const std::vector<FormatWord>& words);

/// Sets the columns of all cells and comments. If `respelled`, words may be spelled otherwise than
/// in the source. Then the distance between a column of words and the widest words before that
/// column stays as in the source.
void place_words(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines,
                 bool respelled);

}  // namespace cascade
