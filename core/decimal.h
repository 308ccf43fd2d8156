// Decimal numbers in texts, which not every standard library reads yet.
#pragma once

#include <charconv>

namespace cascade {

/// std::from_chars() for a number in binary64: the nearest one, in any locale.
std::from_chars_result from_decimal(const char* begin, const char* end, double& number);

}  // namespace cascade
