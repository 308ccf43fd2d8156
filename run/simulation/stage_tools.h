// What the time of a stage asks of the simulation, and what its steps read and do not change.
#pragma once

#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"

namespace cascade {

/// `steps` makes the kernels of steps runnable. The view is copied.
StageTools stage_tools(const StageView& view, Compile steps);

/// What no step changes, computed from the present state.
StepInvariants find_step_invariants(const StageView& view);

}  // namespace cascade
