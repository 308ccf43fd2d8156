// Further steps of a stage that has ended, taken to see what they do and undone.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"

#include <cstdint>

namespace cascade {

/// A stage that has ended, its passes and all that may be tried with it.
struct EndedStage {
    const StageView& view;
    StageState& state;  ///< The state of the view; trial steps restore it.
    StageTimer& timer;
};

/// Are there values of which a copy can be had, and steps enough for a few more to cost little?
bool allows_trial_steps(const EndedStage& ended);

/// Steps of such a stage that may be tried: no more than a quarter of those before.
inline constexpr std::int64_t most_trial_steps = 8, least_trial_steps = 4;

/// Takes `count` steps by `timer`; `observe` sees the state before and after each. False where a
/// value was spoiled.
bool take_trial_steps(const EndedStage& ended, StageTimer& timer, std::int64_t count,
                      const Observer& observe);

}  // namespace cascade
