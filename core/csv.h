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

/// A number with nine digits, enough to read a binary32 back; an empty cell if it is not finite.
std::string csv_number(double value);
/// The shortest text that reads back as the same number of this precision.
std::string csv_number(double value, Precision precision);

struct CsvCell {
    std::string text;                  ///< Without quotes, and without blanks around it.
    std::size_t line = 1, column = 1;  ///< Of its first character, in characters.
    bool is_quoted = false;
};

/// The rows of a table, with line ends of any kind, with or without a byte order mark. Lines of
/// blanks are left out. Fails on a quoted cell without an end or with text after it; the message
/// begins with "LINE:COLUMN: ".
Result<std::vector<std::vector<CsvCell>>> read_csv(std::string_view text);

}  // namespace cascade
