// Messages for runs that blow up or are about to.
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
    std::string place;  ///< Describes the cell.
    StepInUse use;
    // Only with a kept copy:
    std::optional<double> largest_before;  ///< The largest magnitude before that step.
    StabilityEstimate estimate_before;     ///< At the last check before.
    double largest_at_start = 0;  ///< The largest magnitude of a starting value of the stage.
    StabilityEstimate estimate_at_start;  ///< At the stage's starting values.
};

/// The largest magnitude of all values.
double largest_magnitude(std::span<const Field> species);

/// Names the stage, species, cell and step, and the largest stable speed if the step is to blame.
Failure describe(const NotFiniteReport& report);

}  // namespace cascade
