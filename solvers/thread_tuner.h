// Chooses the number of threads. Using all threads is not always fastest: if other programs keep
// cores busy, every step waits for the thread that has lost its core. So from time to time some
// steps use fewer or more threads, and the fastest number stays in use. No result depends on this
// number.
#pragma once

#include <chrono>
#include <cstdint>

namespace cascade {

class ThreadTuner {
public:
    /// Starts with all `most` threads.
    explicit ThreadTuner(int most) : most_(most), best_(most), current_(most) {}

    /// The number of threads for the next batch.
    int threads() const { return current_; }
    /// Whether another number of threads is being tried.
    bool is_trying() const { return current_ != best_; }

    /// Records the time of a batch of `count` steps by threads() threads.
    void took(std::int64_t count, std::chrono::duration<double> duration);

private:
    /// The time and the number of steps with one number of threads.
    struct Measured {
        double seconds = 0;
        double steps = 0;
        double seconds_per_step() const { return seconds / steps; }
    };

    int candidate(int turn) const;
    void begin_trial();
    void end_trial();

    int most_;
    int best_;
    int current_;               ///< The number in use, which differs from best_ during a trial.
    int turn_ = 0;              ///< Determines the next candidate.
    double until_trial_ = 0.1;  ///< Seconds until the next trial.
    double between_trials_ = 0.1;
    Measured recent_;  ///< Steps with best_ threads, over about the last tenth of a second.
    Measured trial_;
};

}  // namespace cascade
