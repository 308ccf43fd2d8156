// Non-finite numbers in single precision, the default of kernels.
#pragma once

#include <limits>

namespace cascade::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace cascade::test
