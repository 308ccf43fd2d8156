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

/// Steps between two computations of the bounds. An estimate costs more than a bound by rule.
std::int64_t choose_every(Solver solver, bool by_rule);

/// The longest stable step of at most `wanted` at that state, and its number of stages. Steps are
/// `step_safety` times the limit of stability. For a stabilised or semi-implicit solver diffusion
/// is stable at any length, and a step is at most `reaction_part` / (bound of the reaction) long. A
/// stabilised solver takes that length, or the longest step of fewer stages, whichever needs fewer
/// evaluations of the rates for the same time. Bounds are finite; a bound of 0 limits nothing.
SafeStep safe_step(Solver solver, const RateBounds& bounds, double wanted);

/// The longest stable step with this number of stages; infinite if nothing limits it.
double stable_step(Solver solver, const RateBounds& bounds, std::uint32_t stages);

/// The number of stages of a stabilised solver for a step of that length.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

inline constexpr double step_safety = 0.9;
/// The error estimate decides how accurate a step is. This margin only avoids steps that amplify
/// what should decay.
inline constexpr double reaction_part = 1.8;

}  // namespace cascade
