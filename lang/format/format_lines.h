// The lines of a formatted script (internal to the formatter): which words share a line, and their
// columns.
#pragma once

#include "lang/format/format_words.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct FormatLine {
    /// A word on its line, other than a comment.
    struct Cell {
        std::size_t word = 0;
        std::size_t column = 0;
    };
    std::vector<Cell> cells;
    std::optional<std::size_t> comment;  ///< The word after the cells, or alone on the line.
    std::size_t comment_column = 0;
    std::size_t indentation = 0;  ///< The line's first column. Not set if it continues a statement.
    bool goes_on = false;         ///< Continues a statement of an earlier line.
    bool blank_line_before = false;
};

/// Splits words into lines. Sets no column but the indentation.
std::vector<FormatLine> format_lines(const std::vector<FormatWord>& words);

/// Sets the columns of all cells and comments. Words spelled differently from the source
/// (`respelled`) keep their distance from the widest words before their column.
void place_words(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines,
                 bool respelled);

}  // namespace cascade
