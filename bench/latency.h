// How long a user waits: from text to first step, for a changed parameter, for Turk's own grid.
#pragma once

#include "ir/backend.h"

#include <memory>

namespace cascade::bench {

/// Measures and prints the first use of the compiler in this process, so it must be the first thing
/// that is done; returns the backend that was made.
std::unique_ptr<Backend> first_use(int lanes);

/// Measures and prints later compiles, changes that need none, and 64 × 64 × 2000 steps.
void later_use(Backend& backend);

}  // namespace cascade::bench
