// How steps went through memory, in words and numbers.
#pragma once

#include "solvers/tiling.h"

#include <string>

namespace cascade {

/// How steps go through memory.
struct Stepping {
    std::string words;  ///< For people: "16 steps a pass".
    std::string why;    ///< Why just so, where that is worth a word: "all stays in the cache".
    double sweeps_at_once =
        1;                ///< Passes of steps for each pass through memory, on average; at least 1.
    double meetings = 1;  ///< Of all threads, in a step.
    /// Bytes of the layers that a thread has in use, where more than one sweep is done at once.
    double bytes_in_use = 0;

    std::string in_words() const { return why.empty() ? words : words + ": " + why; }
};

/// How a problem is stepped with so many levels; tiles have so many `phases` between meetings.
Stepping stepping_with(const StepProblem& problem, const Tiling& tiling, int levels, int phases);

}  // namespace cascade
