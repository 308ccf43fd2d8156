// Measures how long a user waits: from text to first step, after a change of a parameter, and for
// 2000 steps on Turk's own grid.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade::bench {

/// Measures and prints the first use of the compiler in this process, so it must be called before
/// all else. Returns the backend that was made.
std::unique_ptr<Backend> first_use(int lanes);

/// Measures and prints later compilations, changes that need none, and 2000 steps of 64 × 64 cells.
void later_use(Backend& backend);

}  // namespace cascade::bench
