// How fast a run proceeds: batch sizes that let it respond quickly, and the rate and remaining time
// for the user.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>

namespace cascade {

/// Callers pass times in, so that a test can choose them.
class Pace {
public:
    using Time = std::chrono::steady_clock::time_point;

    Pace(Time now, std::int64_t step);

    /// The number of steps to take before the clock and `cancel` are read again: about 20 ms of
    /// work. At least `wanted`, which are faster together, if they take at most half a second.
    std::int64_t batch(std::int64_t wanted = 1) const {
        return std::max(batch_, std::min(wanted, patient_batch_));
    }
    /// Records the time of a batch of `count` steps.
    void took(std::int64_t count, std::chrono::duration<double> duration);

    /// Continues after a pause: reports leave out the pause, and batches keep their size.
    void go_on(Time now, std::int64_t step);

    /// Is it time for a report? About ten times a second.
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
