// Tables of comma-separated values, as RFC 4180 has them but with plain line ends.
#pragma once

#include "core/precision.h"

#include <span>
#include <string>
#include <string_view>

namespace cascade {

/// A line of a table. What holds a comma, a quote or a line end is put in quotes.
std::string csv_row(std::span<const std::string> cells);

/// A number with nine digits, as many as binary32 needs to be read back; nothing for one that is
/// not finite, as spreadsheets have it.
std::string csv_number(double value);
/// The shortest text that is read back as the same number of a precision.
std::string csv_number(double value, Precision precision);

}  // namespace cascade
