// FFTW makes one plan at a time; transforms themselves may run at once.
#pragma once

#include <mutex>

namespace cascade {

/// Held by whoever makes or destroys a plan, in whatever precision.
std::mutex& transform_planner();

}  // namespace cascade
