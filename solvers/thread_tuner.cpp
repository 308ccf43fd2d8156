// Tries several numbers of threads and measures their speed.
#include "solvers/thread_tuner.h"

#include <algorithm>

namespace cascade {
namespace {

// The duration of a trial, longer than a time slice of the operating system. Trials become rare
// with time, so that a bad trial costs little.
constexpr double trial_seconds = 0.02;
constexpr double first_trial = 0.1;
constexpr double longest_between_trials = 4;
constexpr double rest_per_trial = 20;
/// The number of threads changes only if a step then takes less than this fraction of the time.
constexpr double worth_changing = 0.95;

}  // namespace

void ThreadTuner::took(std::int64_t count, std::chrono::duration<double> duration) {
    if (most_ == 1) return;
    const auto steps = static_cast<double>(count);
    if (is_trying()) {
        trial_.seconds += duration.count();
        trial_.steps += steps;
        if (trial_.seconds >= trial_seconds) end_trial();
        return;
    }
    // The weight of old measurements decays, so that recent measurements are compared.
    const double old = std::max(0.0, 1 - duration.count() / first_trial);
    recent_.seconds = recent_.seconds * old + duration.count();
    recent_.steps = recent_.steps * old + steps;
    until_trial_ -= duration.count();
    if (until_trial_ <= 0) begin_trial();
}

/// The number of threads to try in a turn: half or twice the best number, 1 or all. One thread may
/// be faster even if half as many threads are not.
int ThreadTuner::candidate(int turn) const {
    switch (turn % 4) {
        case 0: return std::max(best_ / 2, 1);
        case 1: return 1;
        case 2: return std::min(best_ * 2, most_);
        default: return most_;
    }
}

void ThreadTuner::begin_trial() {
    // The loop ends, because 1 or most_ differs from best_.
    while (candidate(turn_) == best_) ++turn_;
    current_ = candidate(turn_);
    trial_ = {};
}

void ThreadTuner::end_trial() {
    if (trial_.seconds_per_step() < worth_changing * recent_.seconds_per_step()) {
        best_ = current_;  // `turn_` stays, because the same change may help again.
        recent_ = trial_;
        between_trials_ = first_trial;
    } else {
        current_ = best_;
        ++turn_;
        between_trials_ = std::min(2 * between_trials_, longest_between_trials);
    }
    until_trial_ = std::max(between_trials_, rest_per_trial * trial_.seconds);
}

}  // namespace cascade
