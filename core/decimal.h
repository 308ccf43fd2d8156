// Reads decimal numbers, because std::from_chars() of some standard libraries reads integers only.
#pragma once

#include <charconv>

namespace cascade {

/// Reads a number as std::from_chars() does: rounded to the nearest binary64 number, in any locale.
std::from_chars_result from_decimal(const char* begin, const char* end, double& number);

}  // namespace cascade
