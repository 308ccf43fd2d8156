// Lets long computations of a step end when the run is cancelled (internal to solvers/).
#pragma once

#include "core/parallel.h"

#include <atomic>

namespace cascade {

/// Abandons the work if `cancel`, which may be null, has become true.
inline void leave_if(const std::atomic<bool>* cancel) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) abandon_work();
}

}  // namespace cascade
