// Decides the number of steps in a batch, the number of threads and the tiling. These choices
// affect speed only, never results.
#pragma once

#include "solvers/loop_clock.h"
#include "solvers/pace.h"
#include "solvers/stepper.h"
#include "solvers/thread_tuner.h"
#include "solvers/tile_tuner.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

namespace cascade {

class BatchTuner {
public:
    using Clock = std::chrono::steady_clock;

    /// Takes steps with `stepper`, and sets its threads and tiling. All arguments must outlive the
    /// tuner.
    BatchTuner(const Schedule& schedule, LoopClock& clock, Stepper& stepper);

    /// Must be called when the time loop continues after a pause, so that the pause is not
    /// measured.
    void go_on();
    /// Returns the number of steps in the next batch, at most `most`. Sets the stepper's threads
    /// and tiling for this batch.
    std::int64_t begin_batch(std::int64_t most);
    /// Records the end of a batch.
    void end_batch(std::int64_t count, Clock::time_point now);
    /// Takes `count` steps of equal length with the passes of `problem`. If `look` is true, returns
    /// whether all values are finite, otherwise returns true.
    bool take_steps(const StepProblem& problem, std::int64_t count, bool look);
    /// Takes one step whose error is estimated, by calling `take`, and returns its result.
    bool take_judged_step(const std::function<bool()>& take);

    int threads() const { return thread_tuner_.threads(); }
    Pace& pace() { return pace_; }
    /// How the last steps used the caches; see Stepping.
    Stepping stepping() const;

private:
    using Seconds = std::chrono::duration<double>;

    bool renew_tile_tuner();
    std::vector<Tiling> tilings_to_try() const;
    TileTuner tuner_of(std::vector<Tiling> tilings) const;
    std::int64_t sweeps_of_step() const;
    std::int64_t steps_at_once() const;
    Seconds time_left(Seconds of_step) const;

    const Schedule& schedule_;
    LoopClock& clock_;
    Stepper& stepper_;
    Pace pace_;
    ThreadTuner thread_tuner_;
    TileTuner tile_tuner_;
    Clock::time_point began_;       ///< The time at which the present batch began.
    bool is_good_measure_ = false;  ///< Whether the present batch measures the speed of threads.
    Seconds spent_{};               ///< The time in batches so far.
};

}  // namespace cascade
