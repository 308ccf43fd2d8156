// Further steps of a stage that has ended, taken to see their effect and then undone.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"

#include <cstdint>

namespace cascade {

/// A stage that has ended, with everything that trial steps need.
struct EndedStage {
    const StageView& view;
    StageState& state;  ///< The state of the view; trial steps restore it.
    StageTimer& timer;
};

/// Can the species be copied, and were there enough steps that a few more cost little?
bool allows_trial_steps(const EndedStage& ended);

/// The number of trial steps: at most a quarter of those before.
inline constexpr std::int64_t most_trial_steps = 8, least_trial_steps = 4;

/// Takes `count` steps with `timer`; `observe` receives the state before the first and after each.
/// Returns false if a value was spoiled.
bool take_trial_steps(const EndedStage& ended, StageTimer& timer, std::int64_t count,
                      const Observer& observe);

}  // namespace cascade
