// How many threads a run uses. All of them are not always the fastest: where other programs keep
// cores busy, every step waits for the thread that has lost its core. So now and then some steps
// are taken by fewer or by more, and what is faster stays. No result depends on it.
#pragma once

#include <chrono>
#include <cstdint>

namespace cascade {

class ThreadTuner {
public:
    /// Starts with all `most` threads.
    explicit ThreadTuner(int most) : most_(most), best_(most), current_(most) {}

    /// How many the next batch of steps is to use.
    int threads() const { return current_; }
    /// Are they being tried?
    bool is_trying() const { return current_ != best_; }

    /// A batch of `count` steps by threads() threads took so long.
    void took(std::int64_t count, std::chrono::duration<double> duration);

private:
    /// Time and steps of one number of threads.
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
    int current_;               ///< Differs from best_ during a trial.
    int turn_ = 0;              ///< Whose turn to be tried it is.
    double until_trial_ = 0.1;  ///< Seconds.
    double between_trials_ = 0.1;
    Measured recent_;  ///< Of best_, the last tenth of a second or so.
    Measured trial_;
};

}  // namespace cascade
