// Times batches. From these times the tuners choose threads and tiles.
#include "solvers/batch_tuner.h"

#include <algorithm>
#include <utility>

namespace cascade {

BatchTuner::BatchTuner(const Schedule& schedule, LoopClock& clock, Stepper& stepper)
    : schedule_(schedule),
      clock_(clock),
      stepper_(stepper),
      pace_(Clock::now(), clock.step),
      thread_tuner_(stepper.executor().most_threads()),
      tile_tuner_(tuner_of(tilings_to_try())) {}

void BatchTuner::go_on() { pace_.go_on(Clock::now(), clock_.step); }

std::int64_t BatchTuner::begin_batch(std::int64_t most) {
    stepper_.executor().use_threads(thread_tuner_.threads());
    stepper_.executor().use_tiling(tile_tuner_.tiling());
    std::int64_t steps = std::min(pace_.batch(steps_at_once()), most);
    if (tile_tuner_.is_trying()) {
        const std::int64_t sweeps = sweeps_of_step();
        steps = std::min(steps, (tile_tuner_.sweeps_of_trial() + sweeps - 1) / sweeps);
    }
    // Measurements are useless for tuning if steps are interpreted, wholly or in part.
    is_good_measure_ = !stepper_.problem().is_provisional() && !tile_tuner_.is_trying();
    began_ = Clock::now();
    return steps;
}

void BatchTuner::end_batch(std::int64_t count, Clock::time_point now) {
    const Seconds duration = now - began_;
    spent_ += duration;
    pace_.took(count, duration);
    if (is_good_measure_) thread_tuner_.took(count, duration);
}

bool BatchTuner::take_steps(const StepProblem& problem, std::int64_t count, bool look) {
    if (&problem != &stepper_.problem()) {
        stepper_.use(problem);
        renew_tile_tuner();
    }
    const bool is_native = !problem.is_provisional();
    // Trials of tilings measure steps without checks, and only while the number of threads is
    // fixed.
    const bool is_trial = tile_tuner_.is_trying();
    stepper_.set_clock(clock_.time.clock);
    const Clock::time_point before = Clock::now();
    const bool finite = stepper_.advance(clock_.step, count, look && !is_trial);
    const Seconds duration = Clock::now() - before;
    clock_.step += count;
    if (is_native && !thread_tuner_.is_trying()) {
        const Seconds of_step = duration / static_cast<double>(count);
        tile_tuner_.took(count * sweeps_of_step(), duration, time_left(of_step));
    }
    return look && is_trial ? stepper_.is_finite() : finite;
}

bool BatchTuner::take_judged_step(const std::function<bool()>& take) {
    // If the errors of only some steps are estimated, only the other steps are measured.
    if (!schedule_.judges_all) return take();
    const StepProblem& problem = stepper_.problem();
    const bool is_native = !problem.is_provisional();
    const Clock::time_point before = Clock::now();
    if (!take()) return false;
    const Seconds duration = Clock::now() - before;
    const bool is_same = &stepper_.problem() == &problem || !renew_tile_tuner();
    if (is_same && is_native && !thread_tuner_.is_trying())
        tile_tuner_.took(sweeps_of_step(), duration, time_left(duration));
    return true;
}

/// Restarts the tile tuner and returns true if the candidate tilings for the present passes have
/// changed. Otherwise the tuner's measurements remain valid.
bool BatchTuner::renew_tile_tuner() {
    auto tilings = tilings_to_try();
    if (tilings == tile_tuner_.candidates()) return false;
    tile_tuner_ = tuner_of(std::move(tilings));
    return true;
}

Stepping BatchTuner::stepping() const {
    Stepping stepping = stepper_.executor().stepping();
    if (const std::string how = tile_tuner_.how_found(); !how.empty()) stepping.why = how;
    return stepping;
}

std::vector<Tiling> BatchTuner::tilings_to_try() const {
    return schedule_.tiling ? std::vector{*schedule_.tiling} : stepper_.executor().tilings_to_try();
}

TileTuner BatchTuner::tuner_of(std::vector<Tiling> tilings) const {
    return TileTuner(std::move(tilings), schedule_.tilings, stepper_.executor().most_threads());
}

std::int64_t BatchTuner::sweeps_of_step() const {
    return static_cast<std::int64_t>(stepper_.problem().passes.size());
}

/// The number of steps taken together while their values are in a cache, at least 1.
std::int64_t BatchTuner::steps_at_once() const {
    const std::int64_t sweeps = sweeps_of_step();
    return (stepper_.executor().levels() + sweeps - 1) / sweeps;
}

/// The estimated time of the remaining steps. If their number is unknown, returns the time spent so
/// far.
BatchTuner::Seconds BatchTuner::time_left(Seconds of_step) const {
    if (schedule_.check > 0) return spent_ + (Clock::now() - began_);
    const auto by_number = static_cast<double>(schedule_.planned_step - clock_.step);
    const bool has_end = clock_.has_end_time();
    return of_step * (has_end ? std::min(by_number, clock_.steps_left()) : by_number);
}

}  // namespace cascade
