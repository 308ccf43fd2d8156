// Large numbers for messages.
#pragma once

#include <cstdint>
#include <string>

namespace cascade {

/// The number with a comma between groups of three digits: "1,234,567".
std::string with_commas(std::int64_t number);

}  // namespace cascade
