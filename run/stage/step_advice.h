// Suggests settings if a time step is too long.
#pragma once

#include "ir/solver.h"
#include "solvers/stability.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// The way in which a stage takes its steps.
struct StepInUse {
    double speed = 0;  ///< The length of a step. NaN if it varies by cell.
    Solver solver = Solver::euler;
    bool is_chosen = false;  ///< Whether `speed: auto` or an adaptive solver chooses the length.
    /// The number of steps after which the stage ends. 0 if a duration or `until` ends the stage.
    std::int64_t iterations = 0;
    /// Whether diffusion, and not the reaction, limits the step. If so, steps of the
    /// Runge-Kutta-Legendre solvers can be far longer.
    bool diffusion_limits = false;
};

/// Returns the longest stable step of the solver in use, whose stability interval may be longer
/// than the interval of explicit Euler. Returns an empty optional if the estimate has no
/// eigenvalue, or if the solver has no such limit. Also returns an empty optional if the limit is
/// less than 10⁻⁹ of the step in use, because the state is then already meaningless.
std::optional<double> longest_step(const StabilityEstimate& estimate, const StepInUse& use);

/// Whether the step exceeds the limit by so much that the result may be wrong. True if the length
/// of the step varies by cell.
bool is_too_long(const StepInUse& use, double limit);

/// Writes advice: "the largest stable speed is about 0.83 and this stage's is 1; try 'speed: 0.75;
/// iterations: 400'", with which the stage covers the same time. Suggests a solver for long steps
/// if this saves enough time.
std::string advise(double limit, const StepInUse& use);

}  // namespace cascade
