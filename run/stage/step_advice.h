// What to write in place of a time step that is too long.
#pragma once

#include "ir/solver.h"
#include "solvers/stability.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade {

/// How a stage takes its steps.
struct StepInUse {
    double speed = 0;  ///< The length of a step; NaN where it varies by cell.
    Solver solver = Solver::euler;
    bool is_chosen = false;  ///< By `speed: auto` or an adaptive solver.
    std::int64_t iterations =
        0;  ///< After so many the stage ends; 0 where its duration or `until` ends it.
    /// Diffusion limits the step and not the reaction, so that stages of Runge-Kutta-Legendre take
    /// far longer ones.
    bool diffusion_limits = false;
};

/// The longest stable step of the solver in use, whose stability interval may be longer than that
/// of explicit Euler. Empty where the estimate has none, where the solver has no such limit, and
/// where it is less than 10⁻⁹ of the step in use: then the state has been spoiled already.
std::optional<double> longest_step(const StabilityEstimate& estimate, const StepInUse& use);

/// Is a step so much longer than the limit that this may have spoiled a run? Where it varies by
/// cell nobody knows, so it is taken to be.
bool is_too_long(const StepInUse& use, double limit);

/// "the largest stable speed is about 0.83 and this stage's is 1; try 'speed: 0.75; iterations:
/// 400'", which is the same time, and the solver for long steps where one is worth it.
std::string advise(double limit, const StepInUse& use);

}  // namespace cascade
