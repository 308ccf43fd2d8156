// Suggests what to write if a time step is too long.
#pragma once

#include "ir/solver.h"
#include "solvers/stability.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// How a stage takes its steps.
struct StepInUse {
    double speed = 0;  ///< The length of a step; NaN if it varies by cell.
    Solver solver = Solver::euler;
    bool is_chosen = false;       ///< By `speed: auto` or an adaptive solver.
    std::int64_t iterations = 0;  ///< The number of steps after which the stage ends; 0 if its
                                  ///< duration or `until` ends it.
    /// Diffusion limits the step, not the reaction, so stages of Runge-Kutta-Legendre can be far
    /// longer.
    bool diffusion_limits = false;
};

/// The longest stable step of the solver in use, whose stability interval may be longer than that
/// of explicit Euler. Empty if the estimate has no eigenvalue, if the solver has no such limit, and
/// if the limit is less than 10⁻⁹ of the step in use, because the state is then spoiled already.
std::optional<double> longest_step(const StabilityEstimate& estimate, const StepInUse& use);

/// Does the step exceed the limit by so much that this may have spoiled the run? If the step varies
/// by cell, the answer is yes.
bool is_too_long(const StepInUse& use, double limit);

/// "the largest stable speed is about 0.83 and this stage's is 1; try 'speed: 0.75; iterations:
/// 400'", which covers the same time, and the solver for long steps if it is worth it.
std::string advise(double limit, const StepInUse& use);

}  // namespace cascade
