// How long steps may be: what `speed: auto` and the stages of Runge-Kutta-Legendre are chosen by.
#pragma once

#include "lang/program.h"
#include "solvers/advance.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// Magnitudes at some state, in 1 / time (lang/derivative.h).
struct RateBounds {
    double whole = 0;     ///< No eigenvalue of the rates' Jacobian is larger.
    double reaction = 0;  ///< Of what neither stages nor implicit diffusion tame.
    bool jumps = false;   ///< Thresholds decide, which no bound knows of.
};

/// Steps between two choices. An estimate costs more than a bound by rule.
std::int64_t choose_every(Solver solver, bool by_rule);

/// The longest step that is safe at that state, and for stabilised solvers accurate, but no longer
/// than a twentieth of `duration`; and how many stages it takes. Steps are `step_safety` times the
/// limit of stability. A stabilised one, whose stages make diffusion stable at any length, is at
/// most `reaction_part` / (bound of the reaction) long, or `reaction_part_with_jumps` over it where
/// rates jump; it has that length or the most that fewer stages allow, whichever takes fewer
/// evaluations of the rates for a stretch of time. A semi-implicit one has that length. Where bounds
/// are not finite, or there are none, the step is a thousandth of the duration.
StepChoice choose_step(Solver solver, const RateBounds& bounds, double duration);

/// The stages of a stabilised solver for a step of that length.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

inline constexpr double step_safety = 0.9;
inline constexpr double reaction_part = 0.6, reaction_part_with_jumps = 0.1;

}  // namespace cascade
