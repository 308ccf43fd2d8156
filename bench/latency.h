// Measures how long a user waits: from text to first step, after a change of a parameter, and for
// 2000 steps on Turk's own grid.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade::bench {

/// Measures and prints how long the first use of the compiler in this process takes, so it must be
/// called before all else. Returns the backend that was made.
std::unique_ptr<Backend> first_use(int lanes);

/// Measures and prints how long later compilations, changes without compilation, and 2000 steps of
/// 64 × 64 cells take.
void later_use(Backend& backend);

}  // namespace cascade::bench
