// The progress of a stage's time loop, and the step at which it must stop next.
#pragma once

#include "solvers/schedule.h"

#include <cmath>
#include <cstdint>

namespace cascade {

class LoopClock {
public:
    explicit LoopClock(const Schedule& schedule);

    std::int64_t step;       ///< Number of complete steps.
    std::int64_t last_look;  ///< The step of the last check for non-finite values.
    TimeState time;

    double now() const { return time.clock.at(step); }
    void set_step(double length) { time.clock.set_step(step, length); }
    /// Continues from the present step. Observations at marks before this step count as done.
    void go_on();

    bool has_end_time() const { return std::isfinite(schedule_.end_time); }
    /// The next time at which a step must end; infinity if no end is set.
    double next_end() const;
    bool is_over() const;
    /// Whether the loop has reached the end of the schedule.
    bool is_at_last_step() const { return step >= schedule_.last_step; }
    /// The number of remaining steps. If the stage has an end time, the number follows from the
    /// remaining time and the present length of steps, otherwise from the schedule.
    double steps_left() const;

    bool is_judging() const { return schedule_.tolerance > 0; }
    /// Whether the error of the next step is estimated.
    bool judges_next() const;
    /// The step after which values are checked next. Does not depend on the last step of the
    /// present call. Pictures and ends of stages always follow a check. Steps change their length
    /// only after a check, so that the steps since the last check can be repeated. If the next step
    /// would pass the end, it is shortened.
    std::int64_t next_check();
    /// Whether the present step must be observed. Must be called once for each step.
    bool observation_due();

private:
    std::int64_t whole_steps_left() const;
    std::int64_t steps_until(double t) const;
    std::int64_t steps_before_moment() const;
    bool looks_at_marks() const { return schedule_.marks || schedule_.interval == 0; }

    const Schedule& schedule_;
    double marks_seen_ = 0;
};

}  // namespace cascade
