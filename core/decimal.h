// Reading decimal numbers, which some standard libraries do not offer yet.
#pragma once

#include <charconv>

namespace cascade {

/// std::from_chars() for a binary64 number: rounds to the nearest one, in any locale.
std::from_chars_result from_decimal(const char* begin, const char* end, double& number);

}  // namespace cascade
