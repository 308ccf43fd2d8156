// Computes the values of the simulation that a stage's timer needs, and the step-invariants.
#pragma once

#include "run/simulation/simulation.h"
#include "run/simulation/stage_view.h"
#include "run/stage/stage_time.h"
#include "run/stage/step_work.h"

#include <cstdint>

namespace cascade {

/// Makes the tools of a stage's timer. `steps` makes the kernels of steps. The view is copied.
StageTools stage_tools(const StageView& view, Compile steps);

/// Computes the step-invariants from the present state.
StepInvariants find_step_invariants(const StageView& view);

/// Counts the work of one step of a started stage in its present state.
StepWork step_work(Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
