// How long steps may be, for `speed: auto` and for the stages of Runge-Kutta-Legendre.
#pragma once

#include "ir/solver.h"
#include "solvers/stage_clock.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// A length of steps, and the number of stages of a stabilised solver.
struct SafeStep {
    double length = 0;
    std::uint32_t stages = 0;
};

inline constexpr double step_safety = 0.9;
/// The longest step of a solver that takes long steps, times the bound of the reaction, at the
/// default tolerance. The error is relative to all of a value, so it does not see that a small
/// perturbation grows too slowly; this limit does.
inline constexpr double reaction_part = 1.8;
/// The same at a tolerance: proportional to the step that has this error. At most `reaction_part`
/// for partly implicit solvers, whose explicit part is unstable beyond 2 or whose equations are
/// singular a little farther on, and at most 6 for others.
double reaction_part_at(Solver solver, double tolerance);

/// Steps between two computations of the bounds. An estimate costs more than a bound by rule.
std::int64_t choose_every(Solver solver, bool by_rule);

/// The longest stable step of at most `wanted` at that state, and its number of stages. Steps are
/// `step_safety` times the limit of stability. For a stabilised or semi-implicit solver diffusion
/// is stable at any length, and a step is at most `part` / (bound of the reaction) long. A
/// stabilised solver takes that length, or the longest step of fewer stages, whichever needs fewer
/// evaluations of the rates for the same time. For a solver that is implicit in each cell, the
/// bounds are those of the terms that read other cells, and of growth. Bounds are finite; a bound
/// of 0 limits nothing.
SafeStep safe_step(Solver solver, const RateBounds& bounds, double wanted,
                   double part = reaction_part);

/// The longest stable step with this number of stages; infinite if nothing limits it.
double stable_step(Solver solver, const RateBounds& bounds, std::uint32_t stages);

/// The number of stages of a stabilised solver for a step of that length.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

}  // namespace cascade
