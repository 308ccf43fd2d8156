// Numbers with units, for people.
#pragma once

#include <string>

namespace cascade {

/// Three digits and the prefix of a unit that follows: "1.23 G", "45.6 M", "789 ", "4.5 m", "12 n"; 0 is
/// "0 ". `value` is not negative.
std::string with_prefix(double value);

/// Bytes in units of 1024: "32 KiB", "1.5 MiB".
std::string byte_size(double bytes);

}  // namespace cascade
