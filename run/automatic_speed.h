// How long steps may be: what `speed: auto` and the stages of Runge-Kutta-Legendre are chosen by.
#pragma once

#include "ir/diffusion.h"
#include "lang/program.h"
#include "solvers/advance.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// Magnitudes that no eigenvalue of the rates' Jacobian exceeds, in 1 / time, at some state.
struct RateBounds {
    double whole = 0;     ///< Reaction and diffusion.
    double reaction = 0;  ///< The reaction alone.
};

/// The rate at which the fastest wave grows by diffusion whose factors are nowhere below these; 0
/// where all waves are damped.
double fastest_growth(const DiffusionTerms<double>& least, const Grid& grid);

/// Steps between two choices.
std::int64_t choose_every(Solver solver);

/// The longest step that is safe at that state, and for stabilised solvers accurate, but no longer
/// than a twentieth of `duration`; and how many stages it takes. Steps are `safety` times the limit
/// of stability; a stabilised one, whose stages make diffusion stable at any length, is as long as
/// the reaction allows: `reaction_part` / (bound of the reaction), and so is a semi-implicit one, for
/// which growth by diffusion counts as reaction. Where bounds are not finite, or
/// there are none, the step is a thousandth of the duration.
StepChoice choose_step(Solver solver, const RateBounds& bounds, double duration);

/// The stages of a stabilised solver for a step of that length.
std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step);

inline constexpr double step_safety = 0.9;
inline constexpr double reaction_part = 0.7;

}  // namespace cascade
