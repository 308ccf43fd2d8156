// The progress of a stage's time loop, and when it must stop next.
#pragma once

#include "solvers/schedule.h"

#include <cmath>
#include <cstdint>

namespace cascade {

class LoopClock {
public:
    explicit LoopClock(const Schedule& schedule);

    std::int64_t step;       ///< Complete steps.
    std::int64_t last_look;  ///< The step of the last check for non-finite values.
    TimeState time;

    double now() const { return time.clock.at(step); }
    void set_step(double length) { time.clock.set_step(step, length); }
    /// A call continues from this step. Tenths of the duration before it have been observed.
    void go_on();

    bool has_end_time() const { return std::isfinite(schedule_.end_time); }
    bool is_over() const;
    /// Has it reached the end of the schedule?
    bool is_at_last_step() const { return step >= schedule_.last_step; }
    /// The remaining steps at the present length, or by number if there is no end time.
    double steps_left() const;

    bool is_judging() const { return schedule_.tolerance > 0; }
    /// Is the error of the next step estimated?
    bool judges_next() const;
    /// The next step after which values are checked, whatever the last step of the present call.
    /// Pictures and ends of stages always follow a check. Steps change their length only after a
    /// check, so that the steps since the last one can be repeated. A last step that would pass the
    /// end is shortened.
    std::int64_t next_check();
    /// Must the present step be observed? Must be called once for each step.
    bool observation_due();

private:
    std::int64_t whole_steps_left() const;
    std::int64_t steps_until(double t) const;
    std::int64_t steps_before_moment() const;
    bool looks_at_tenths() const { return schedule_.tenths || schedule_.interval == 0; }

    const Schedule& schedule_;
    double tenths_seen_ = 0;
};

}  // namespace cascade
