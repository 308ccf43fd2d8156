// How fast a run goes: batches of steps that are short enough to stay responsive, and the rate and
// remaining time that a user is told.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>

namespace cascade {

/// Times come from outside, so that a test can make them up.
class Pace {
public:
    using Time = std::chrono::steady_clock::time_point;

    Pace(Time now, std::int64_t step);

    /// Steps to take before looking at the clock and at `cancel` again: about 20 ms of work, but at
    /// least `wanted`, which are faster together, where those take half a second or less.
    std::int64_t batch(std::int64_t wanted = 1) const {
        return std::max(batch_, std::min(wanted, patient_batch_));
    }
    /// A batch of `count` steps took so long.
    void took(std::int64_t count, std::chrono::duration<double> duration);

    /// Goes on after a pause: reports tell nothing of the time before, batches are as long.
    void go_on(Time now, std::int64_t step);

    /// Is it time for a report? About ten times a second.
    bool report_due(Time now) const;
    /// Notes the time of a report, at so many complete steps.
    void reported(Time now, std::int64_t step);

    /// Steps per second over the last two seconds of reports; 0 while unknown.
    double steps_per_second() const;

private:
    struct Sample {
        Time time;
        std::int64_t step;
    };
    std::deque<Sample> samples_;
    std::int64_t batch_ = 1;
    std::int64_t patient_batch_ = 1;
};

}  // namespace cascade
