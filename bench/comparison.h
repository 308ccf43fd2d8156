// Compares the throughput of native code with straight C++, by Google Benchmark.
#pragma once

#include "ir/backend.h"

namespace cascade::bench {

/// Checks that both sides compute the same values, up to rounding. Then measures every system at
/// every size and prints medians and ratios. One size is measured after the other. Both sides run
/// in this process and alternate at random.
void compare_throughput(Backend& backend);

}  // namespace cascade::bench
