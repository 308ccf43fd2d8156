// What is the largest time step, and has a run already suffered from one that is too large?
#pragma once

#include "core/plane.h"
#include "solvers/advance.h"

#include <optional>
#include <span>

namespace cascade {

/// The result of a power iteration on the Jacobian of the rates at a state.
struct StabilityEstimate {
    double eigenvalue = 0;                ///< Of largest magnitude, in 1 / time.
    std::optional<double> largest_speed;  ///< 2 / |eigenvalue| where that eigenvalue is negative;
                                          ///< empty where growth has another cause than the step.
};

/// Estimates it at the state `species` by finite differences of the kernel of rates (one result per
/// species, slots as for the step). Deterministic; a few hundred evaluations.
StabilityEstimate estimate_stability(const StepProblem& rates, std::span<const Field> species);

/// The chequerboard mode of a field: |Σ (−1)^(i+j) c| / N divided by the standard deviation of c.
/// Near 1 when neighbours alternate, near 0 for a pattern the grid resolves; 0 for a flat field.
double chequerboard(const Field& field);

/// Above this a field is called a chequerboard and the user is warned.
inline constexpr double chequerboard_threshold = 0.5;

}  // namespace cascade
