// Numbers that are not finite, of the precision that kernels have by default.
#pragma once

#include <limits>

namespace cascade::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace cascade::test
