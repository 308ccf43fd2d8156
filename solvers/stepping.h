// How steps pass through memory, in words and numbers.
#pragma once

#include "solvers/tiling.h"

#include <string>

namespace cascade {

/// How steps pass through memory.
struct Stepping {
    std::string words;          ///< For people: "16 steps a pass".
    std::string why;            ///< The reason, if interesting: "all stays in the cache".
    double sweeps_at_once = 1;  ///< Average number of passes of steps in a pass through memory.
    double meetings = 1;        ///< Barriers of all threads in a step.
    /// Bytes of the layers that a thread uses at a time, if it computes several sweeps at once.
    double bytes_in_use = 0;

    std::string in_words() const { return why.empty() ? words : words + ": " + why; }
};

/// Describes the steps of a problem with this number of levels. Threads meet after each of a tile's
/// `phases`.
Stepping stepping_with(const StepProblem& problem, const Tiling& tiling, int levels, int phases);

}  // namespace cascade
