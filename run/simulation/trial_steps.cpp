// Trial steps change only copies of the species.
#include "run/simulation/trial_steps.h"

#include <limits>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// The largest number of bytes of a copy of the species. Trial steps need such a copy, so they are
/// not taken if it would be larger.
constexpr std::int64_t most_copied_bytes = std::int64_t{64} << 20;

}  // namespace

bool allows_trial_steps(const EndedStage& ended) {
    const StageState& state = ended.state;
    Schedule schedule = ended.timer.schedule(state.steps, 1);
    schedule.most_kept_bytes = most_copied_bytes;
    const Environment& here = ended.view.environment();
    return !ended.view.stage().time.chooses_steps() && state.steps / 4 >= least_trial_steps &&
           keeps_copy(schedule, state.species().size(), here.grid, here.precision());
}

bool take_trial_steps(const EndedStage& ended, StageTimer& timer, std::int64_t count,
                      const Observer& observe) {
    StageState& state = ended.state;
    Schedule schedule = timer.schedule(state.steps, 1);
    schedule.last_step = state.steps + count;
    schedule.end_time = std::numeric_limits<double>::infinity();
    schedule.every = 0;
    schedule.check = 0;
    schedule.ends = {};
    schedule.most_kept_bytes = 0;
    schedule.threads = ended.view.environment().tools.threads;
    // If the stage has a duration, its last step may have been shorter than `speed`.
    const double speed = state.numbers[ended.view.system().speed_item()];
    if (schedule.time.clock.step > 0) schedule.time.clock.set_step(state.steps, speed);

    const std::int64_t steps = state.steps;
    const double t = state.t;
    std::vector<Field> copies;
    for (const Field& field : state.species()) copies.push_back(field.clone());
    bool is_finite = false;
    {
        const OtherSpecies trial(state, std::move(copies));
        observe(steps, t, state.species());
        RunControl unwatched;
        is_finite =
            !advance(timer.problem(), schedule, state.species(), unwatched, {}, observe).not_finite;
    }
    state.go_to(steps, t);
    return is_finite;
}

}  // namespace cascade
