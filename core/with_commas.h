// Large numbers for people.
#pragma once

#include <cstdint>
#include <string>

namespace cascade {

/// "1,234,567".
std::string with_commas(std::int64_t number);

}  // namespace cascade
