// The time of a stage, computed from its steps.
#pragma once

#include "core/precision.h"
#include "solvers/step_control.h"

#include <cstdint>

namespace cascade {

/// Computes the time from the number of complete steps. Steps have the same length until set_step()
/// changes it. From then on, time is counted from the step of this change. So the time of a step is
/// rounded only once, and it does not depend on where a run was interrupted.
struct StageClock {
    /// The step from which on steps have the length `step`.
    std::int64_t base_step = 0;
    double base_time = 0;  ///< The time of `base_step`.
    double step = 0;       ///< The length of a step; 0 if it varies by cell.
    /// The run's precision, in which the number of steps is rounded.
    Precision precision = Precision::single;

    double at(std::int64_t complete) const {
        const double count = with_number(precision, [&](auto zero) -> double {
            return static_cast<decltype(zero)>(complete - base_step);
        });
        return base_time + count * step;
    }
    /// Sets the length of steps from `complete` on.
    void set_step(std::int64_t complete, double length) {
        if (length == step) return;
        base_time = at(complete);
        base_step = complete;
        step = length;
    }
    /// Counts the time from this step on, so that the end of an adaptive step equals the start of
    /// the next one to the bit.
    void begin_at(std::int64_t complete) {
        base_time = at(complete);
        base_step = complete;
    }
};

/// Bounds of the eigenvalues of the rates' Jacobian in some state, in 1 / time
/// (lang/calculus/derivative.h). If the solver is implicit in each cell, `whole` bounds only the
/// terms that read other cells, and `reaction` bounds the rate of growth.
struct RateBounds {
    double whole = 0;  ///< A bound of the magnitude of all eigenvalues.
    /// A bound of the part of the rates that neither a solver's stages nor implicit diffusion
    /// stabilise.
    double reaction = 0;
    /// Whether rates jump at thresholds. The bounds do not include such jumps.
    bool jumps = false;
};

/// The data about an interrupted stage's time that must be saved so that the stage can continue
/// with the same bits.
struct TimeState {
    StageClock clock;
    std::uint32_t stages = 0;  ///< The number of stages in a step of a stabilised solver.
    /// The state of the controller, for steps with an estimated error.
    StepControl::State control;
    // The members below are for steps whose length is chosen.
    double least_step = 0;         ///< A step as short as this is accepted with any error.
    std::int64_t next_judged = 0;  ///< The number of the next step whose error is estimated.
    std::int64_t stretch = 1;      ///< The number of steps between two error estimates.
    /// The number of complete steps when `bounds` were computed; −1 if bounds are unknown.
    std::int64_t bounded_at = -1;
    RateBounds bounds;
};

}  // namespace cascade
