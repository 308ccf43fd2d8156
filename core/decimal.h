// Reads decimal numbers, because std::from_chars() of some standard libraries reads integers only.
#pragma once

#include <charconv>

namespace cascade {

/// std::from_chars() for a binary64 number: rounds to the nearest one, in any locale.
std::from_chars_result from_decimal(const char* begin, const char* end, double& number);

}  // namespace cascade
