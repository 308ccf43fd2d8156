// Explains why a run has produced NaN or infinity, or will soon produce them.
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
    std::string place;  ///< Describes the cell that has the value.
    StepInUse use;
    // The following two members are known only if a copy of the state before the failure exists.
    std::optional<double> largest_before;  ///< The largest absolute value before the failing step.
    StabilityEstimate estimate_before;     ///< The estimate at the last successful check.
    double largest_at_start = 0;  ///< The largest absolute value of the stage's starting values.
    StabilityEstimate estimate_at_start;  ///< The estimate at the stage's starting values.
};

/// Returns the largest absolute value in all fields.
double largest_magnitude(std::span<const Field> species);

/// Makes a message that names the stage, species, cell and step. If the step is too long, the
/// message also gives the largest stable speed.
Failure describe(const NotFiniteReport& report);

}  // namespace cascade
