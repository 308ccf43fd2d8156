// The time of a stage, as its steps go on.
#pragma once

#include "core/precision.h"
#include "solvers/step_control.h"

#include <cstdint>

namespace cascade {

/// Time from the number of complete steps. Steps are of one length until set_step() changes it;
/// then time is counted from there. So the time of a step is rounded once and does not depend on
/// the steps at which a run was interrupted.
struct StageClock {
    std::int64_t base_step = 0;               ///< Where steps of this length began,
    double base_time = 0;                     ///< and the time then.
    double step = 0;                          ///< The length of a step; 0 where it varies by cell.
    Precision precision = Precision::single;  ///< Of the run: steps are counted in its numbers.

    double at(std::int64_t complete) const {
        const double count = with_number(precision, [&](auto zero) -> double {
            return static_cast<decltype(zero)>(complete - base_step);
        });
        return base_time + count * step;
    }
    /// Steps are so long from `complete` on.
    void set_step(std::int64_t complete, double length) {
        if (length == step) return;
        base_time = at(complete);
        base_step = complete;
        step = length;
    }
    /// Counts the time from here on, so that the end of an adaptive step is the start of the next
    /// one to the bit.
    void begin_at(std::int64_t complete) {
        base_time = at(complete);
        base_step = complete;
    }
};

/// Magnitudes of the rates' Jacobian in some state, in 1 / time (lang/calculus/derivative.h).
struct RateBounds {
    double whole = 0;     ///< No eigenvalue is larger.
    double reaction = 0;  ///< Of what neither stages nor implicit diffusion tame.
    bool jumps = false;   ///< Rates jump at thresholds, which no bound knows of.
};

/// What a stage that is interrupted must keep of its time to go on with the same bits.
struct TimeState {
    StageClock clock;
    std::uint32_t stages = 0;    ///< Of a stabilised solver.
    StepControl::State control;  ///< Of steps whose error is estimated.
    // Of steps of chosen length:
    double least_step = 0;  ///< A step as short as this is taken whatever its error.
    std::int64_t next_judged =
        0;                     ///< The error of the step that makes so many complete is estimated;
    std::int64_t stretch = 1;  ///< and that of the one after so many more.
    std::int64_t bounded_at =
        -1;  ///< Complete steps when `bounds` were computed; −1 where they are unknown.
    RateBounds bounds;
};

}  // namespace cascade
