// The time of a stage, from its steps.
#pragma once

#include "core/precision.h"
#include "solvers/step_control.h"

#include <cstdint>

namespace cascade {

/// Computes the time from the number of complete steps. Steps have one length until set_step()
/// changes it. Time is then counted from that step. The time of a step is thus rounded once and
/// does not depend on where a run was interrupted.
struct StageClock {
    std::int64_t base_step = 0;               ///< The step from which steps have this length,
    double base_time = 0;                     ///< and its time.
    double step = 0;                          ///< The length of a step; 0 if it varies by cell.
    Precision precision = Precision::single;  ///< The run's precision, in which steps are counted.

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

/// Bounds of the rates' Jacobian in some state, in 1 / time (lang/calculus/derivative.h). For a
/// solver that is implicit in each cell, `whole` bounds the terms that read other cells, and
/// `reaction` bounds growth.
struct RateBounds {
    double whole = 0;     ///< A bound of all eigenvalues.
    double reaction = 0;  ///< The part that neither stages nor implicit diffusion stabilise.
    bool jumps = false;   ///< Rates jump at thresholds, which the bounds do not include.
};

/// The part of an interrupted stage's time that must be saved to continue with the same bits.
struct TimeState {
    StageClock clock;
    std::uint32_t stages = 0;    ///< For a step of a stabilised solver.
    StepControl::State control;  ///< For steps with an estimated error.
    // For steps of chosen length:
    double least_step = 0;  ///< A step as short as this is accepted whatever its error.
    std::int64_t next_judged =
        0;                     ///< The error is estimated for the step that completes this number,
    std::int64_t stretch = 1;  ///< and for the step this much later.
    std::int64_t bounded_at =
        -1;  ///< Complete steps when `bounds` were computed; −1 if they are unknown.
    RateBounds bounds;
};

}  // namespace cascade
