// Numbers with units, for messages.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A `value` ≥ 0 with three digits and an SI prefix: "1.23 G", "45.6 M", "789", "12.0 n", "0".
std::string with_prefix(double value);
/// with_prefix() followed by the symbol of a unit: "1.23 GB/s", "45.6 µs", "7.89 s".
std::string with_unit(double value, std::string_view unit);

}  // namespace cascade
