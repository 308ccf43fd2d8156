// Comma-separated values as in RFC 4180, but with plain line feeds.
#pragma once

#include "core/precision.h"
#include "core/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A line of a table. Cells with a comma, a quote or a line feed are quoted.
std::string csv_row(std::span<const std::string> cells);

/// The number with nine digits, which are enough to identify any binary32 number. Empty if the
/// number is not finite.
std::string csv_number(double value);
/// The shortest text that reads back as the same number of this precision.
std::string csv_number(double value, Precision precision);

struct CsvCell {
    std::string text;  ///< The content, without quotes and surrounding blanks.
    /// The line and column of the cell's first character, both from 1. Columns count characters.
    std::size_t line = 1, column = 1;
    bool is_quoted = false;
};

/// The rows of a table, with line ends of any kind, with or without a byte order mark. Leaves out
/// lines that contain only blanks. Fails on a quoted cell that has no end or is followed by other
/// text. The message begins with "LINE:COLUMN: ".
Result<std::vector<std::vector<CsvCell>>> read_csv(std::string_view text);

}  // namespace cascade
