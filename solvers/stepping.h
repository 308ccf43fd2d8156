// Describes how many steps are computed while their values are in a cache.
#pragma once

#include "solvers/tiling.h"

#include <string>

namespace cascade {

/// How many steps are computed while their values are in a cache.
struct Stepping {
    std::string words;  ///< Words for users, such as "16 steps a pass".
    std::string why;    ///< The reason, if users should know it, such as "all stays in the cache".
    /// The average number of sweeps (passes of steps) that are computed together while their values
    /// are in a cache.
    double sweeps_at_once = 1;
    double meetings = 1;  ///< The number of barriers of all threads per step.
    /// The bytes of the layers that a thread uses at a time. Set only if several sweeps are
    /// computed at once.
    double bytes_in_use = 0;

    std::string in_words() const { return why.empty() ? words : words + ": " + why; }
};

/// Describes the steps of a problem with this number of levels. Threads wait for each other after
/// each of a tile's `phases`.
Stepping stepping_with(const StepProblem& problem, const Tiling& tiling, int levels, int phases);

}  // namespace cascade
