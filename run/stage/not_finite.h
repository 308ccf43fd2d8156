// Words for runs that blow up, or are about to.
#pragma once

#include "core/result.h"
#include "run/stage/step_advice.h"
#include "solvers/advance.h"
#include "solvers/stability.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

struct NotFiniteReport {
    std::string stage, system, species;
    NotFinite found;
    std::string place;  ///< Of the cell, in words.
    StepInUse use;
    // Only of what was kept:
    std::optional<double> largest_before;  ///< Magnitude of any value before that step.
    StabilityEstimate estimate_before;     ///< At the last look before.
    double largest_at_start = 0;           ///< Magnitude of any starting value of the stage.
    StabilityEstimate estimate_at_start;   ///< At the stage's starting values.
};

/// The largest magnitude of all values.
double largest_magnitude(std::span<const Field> species);

/// Which stage, species, cell and step, and the largest stable speed where the step is to blame.
Failure describe(const NotFiniteReport& report);

}  // namespace cascade
