// The lines of a formatted script: which words share a line, and where on it they stand.
//
// Internal to the formatter.
#pragma once

#include "lang/format/format_words.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct FormatLine {
    /// A word that is no comment on its line.
    struct Cell {
        std::size_t word = 0;
        std::size_t column = 0;
    };
    std::vector<Cell> cells;
    std::optional<std::size_t> comment;  ///< The word after the cells, or alone on the line.
    std::size_t comment_column = 0;
    std::size_t indentation = 0;  ///< Where the line begins; of one that goes on: unknown.
    bool goes_on = false;         ///< Inside a statement that began further up.
    bool blank_line_before = false;
};

/// Splits words into lines; of the columns only the indentation is filled in.
std::vector<FormatLine> format_lines(const std::vector<FormatWord>& words);

/// Fills in the columns of all cells and comments.
void place_words(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines);

}  // namespace cascade
