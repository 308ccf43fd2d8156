// How far the time loop of a stage is, and when it has to stop next.
#pragma once

#include "solvers/schedule.h"

#include <cmath>
#include <cstdint>

namespace cascade {

class LoopClock {
public:
    explicit LoopClock(const Schedule& schedule);

    std::int64_t step;       ///< Complete steps.
    std::int64_t last_look;  ///< The step of the last look for values that are not finite.
    TimeState time;

    double now() const { return time.clock.at(step); }
    void set_step(double length) { time.clock.set_step(step, length); }
    /// A loop goes on where it is, and has looked there.
    void go_on();

    bool has_end_time() const { return std::isfinite(schedule_.end_time); }
    bool is_over() const;
    /// Has it come as far as the schedule says?
    bool is_at_last_step() const { return step >= schedule_.last_step; }
    /// Of steps as long as they are now; by number where there is no end time.
    double steps_left() const;

    bool is_judging() const { return schedule_.tolerance > 0; }
    /// Is the error of the next step estimated?
    bool judges_next() const;
    /// The next step after which values are looked at: no picture is made of values that are not
    /// finite, no stage ends with them, and steps change their length only there, so that those
    /// since the last look can be taken again. Where less than a step is left it is shortened.
    std::int64_t next_stop();
    /// Is the present step to be observed? To be asked once.
    bool observation_due();

private:
    std::int64_t whole_steps_left() const;
    std::int64_t steps_until(double t) const;
    bool looks_at_tenths() const { return schedule_.tenths || schedule_.interval == 0; }

    const Schedule& schedule_;
    double tenths_seen_ = 0;
};

}  // namespace cascade
