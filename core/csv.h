// Comma-separated values as in RFC 4180, but with plain line feeds.
#pragma once

#include "core/precision.h"

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// A line of a table. Cells with a comma, a quote or a line feed are quoted.
std::string csv_row(std::span<const std::string> cells);

/// A number with nine digits, enough to read a binary32 back; an empty cell if it is not finite.
std::string csv_number(double value);
/// The shortest text that reads back as the same number of this precision.
std::string csv_number(double value, Precision precision);

}  // namespace cascade
