// Finds the longest stable steps, for `speed: auto`, and the number of stages of stabilised
// solvers.
#pragma once

#include "ir/solver.h"
#include "solvers/stage_clock.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// The length of a step, and the number of stages of a stabilised solver.
struct SafeStep {
    double length = 0;
    std::uint32_t stages = 0;
};

inline constexpr double step_safety = 0.9;
/// The longest step at the default tolerance, as a multiple of 1 / (bound of the reaction), for a
/// solver that takes long steps. The error estimate alone would allow longer steps. It is relative
/// to the whole value, so it does not show that a small perturbation grows too slowly.
inline constexpr double reaction_part = 1.8;
/// Returns the value that replaces `reaction_part` at another tolerance. It is proportional to the
/// length of a step whose error is this tolerance. For partly implicit solvers it is at most
/// `reaction_part`, because beyond 2 their explicit part becomes unstable or, shortly after, their
/// equations become singular. For other solvers it is at most 6.
double reaction_part_at(Solver solver, double tolerance);

/// Returns the number of steps between two computations of the bounds. It is larger if bounds are
/// estimated, because estimating them takes more time than computing them by rule.
std::int64_t choose_every(Solver solver, bool by_rule);

/// Returns the longest stable step of at most `wanted` at a state with these bounds, and its number
/// of stages. A step is at most `step_safety` times as long as the limit of stability. Stabilised
/// and semi-implicit solvers are stable for diffusion at any length, so only the reaction limits
/// their steps, to `part` / (bound of the reaction). A stabilised solver takes a step of that
/// length, or a shorter step of fewer stages if this needs fewer evaluations of the rates for the
/// same time. For a solver that is implicit in each cell, the bounds cover only growth and the
/// terms that read other cells. Bounds must be finite. A bound of 0 limits nothing.
SafeStep safe_step(Solver solver, const RateBounds& bounds, double wanted,
                   double part = reaction_part);

/// Returns the longest stable step with this number of stages. Returns infinity if the bounds limit
/// nothing.
double stable_step(Solver solver, const RateBounds& bounds, std::uint32_t stages);

/// Returns the number of stages that a stabilised solver needs for a step of length `step`.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

}  // namespace cascade
