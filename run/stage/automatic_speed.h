// How long steps may be: what `speed: auto` and the stages of Runge-Kutta-Legendre are chosen by.
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

/// Steps between two looks at the bounds. An estimate costs more than a bound by rule.
std::int64_t choose_every(Solver solver, bool by_rule);

/// The longest step of at most `wanted` that is stable at that state, and the number of its stages.
/// Steps are `step_safety` times the limit of stability. A stabilised or semi-implicit one, for
/// which diffusion is stable at any length, is at most `reaction_part` / (bound of the reaction)
/// long; a stabilised one has that length or the most that fewer stages allow, whichever takes
/// fewer evaluations of the rates for a stretch of time. Bounds are finite; those that are 0 limit
/// nothing.
SafeStep safe_step(Solver solver, const RateBounds& bounds, double wanted);

/// The longest stable step of so many stages; infinite where nothing limits it.
double stable_step(Solver solver, const RateBounds& bounds, std::uint32_t stages);

/// The stages of a stabilised solver for a step of that length.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

inline constexpr double step_safety = 0.9;
/// How accurate a step is decides the estimate of its error; this only keeps away from steps that
/// grow where they should not.
inline constexpr double reaction_part = 1.8;

}  // namespace cascade
