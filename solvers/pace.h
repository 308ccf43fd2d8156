// Measures the speed of a run. Gives the size of batches with which the run responds quickly, and
// the rate and the remaining time for the user.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>

namespace cascade {

/// Callers pass in the time, so that tests can choose it.
class Pace {
public:
    using Time = std::chrono::steady_clock::time_point;

    Pace(Time now, std::int64_t step);

    /// The number of steps to take before the clock and `cancel` are read again: about 20 ms of
    /// work. `wanted` is the number of steps that are fastest if taken together. If so many steps
    /// take at most half a second, the result is at least `wanted`.
    std::int64_t batch(std::int64_t wanted = 1) const {
        return std::max(batch_, std::min(wanted, patient_batch_));
    }
    /// Records the time of a batch of `count` steps.
    void took(std::int64_t count, std::chrono::duration<double> duration);

    /// Continues after a pause: reports leave out the pause, and batches keep their size.
    void go_on(Time now, std::int64_t step);

    /// Whether it is time for a report, about ten times a second.
    bool report_due(Time now) const;
    /// Records the time of a report and the number of complete steps.
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
