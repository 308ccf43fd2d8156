// Throughput of native code against straight C++, through Google Benchmark.
#pragma once

#include "ir/backend.h"

namespace cascade::bench {

/// Checks that both sides compute the same, to rounding; then measures every system at every size,
/// one size after the other, both sides in this process and interleaved at random, and prints
/// medians and ratios.
void compare_throughput(Backend& backend);

}  // namespace cascade::bench
