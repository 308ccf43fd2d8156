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
    /// The comment after the cells. Without cells, the comment is alone on the line.
    std::optional<std::size_t> comment;
    std::size_t comment_column = 0;
    std::size_t indentation = 0;  ///< The line's first column. Set only if `goes_on` is false.
    bool goes_on = false;         ///< Whether the line continues the statement of an earlier line.
    bool blank_line_before = false;
};

/// Splits words into lines. Sets the indentation of each line, but no other columns.
std::vector<FormatLine> format_lines(const std::vector<FormatWord>& words);

/// Sets the columns of all cells and comments. If `respelled` is true, words may have other
/// spellings than in the source. In this case the distance between a column of words and the widest
/// words before that column stays as in the source.
void place_words(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines,
                 bool respelled);

}  // namespace cascade
