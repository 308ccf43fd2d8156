// Takes a few more steps of a stage that has ended, and restores its state.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"
#include "solvers/advance.h"

#include <cstdint>

namespace cascade {

/// A stage that has ended, with everything needed to take further trial steps.
struct EndedStage {
    const StageView& view;
    StageState& state;  ///< The state that the view shows. It is restored after trial steps.
    StageTimer& timer;
};

/// The largest and the smallest number of trial steps. The number is also at most a quarter of the
/// number of steps that the stage has taken.
inline constexpr std::int64_t most_trial_steps = 8, least_trial_steps = 4;

/// Whether the species can be copied, and whether the stage has taken so many steps that a few more
/// cost little in comparison.
bool allows_trial_steps(const EndedStage& ended);

/// Takes `count` steps with `timer`, and calls `observe` before the first step and after each step.
/// Returns false if a value became NaN or infinite.
bool take_trial_steps(const EndedStage& ended, StageTimer& timer, std::int64_t count,
                      const Observer& observe);

}  // namespace cascade
