// FFTW's planner is not thread-safe, while its transforms are.
#pragma once

#include <mutex>

namespace cascade {

/// The mutex for creating and destroying FFTW plans of any precision, in solvers/ and measure/.
std::mutex& transform_planner();

}  // namespace cascade
