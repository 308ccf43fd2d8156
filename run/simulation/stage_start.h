// Starts stages of either kind. A stage of fields gets its parameters, species and sides.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_view.h"
#include "run/stage/stage_state.h"

#include <atomic>
#include <cstdint>
#include <span>

namespace cascade {

/// Computes the items of a stage that are the same in all cells.
void start_uniform_items(const StageView& view, StageState& state);

/// Computes the starting values of a stage from earlier stages. Fails if `speed` is not above 0, if
/// a side with a flux lies where the surface is sheared, or as start_tissue() does.
Result<void> start_stage(const Environment& environment, std::span<StageState> states,
                         std::uint32_t stage, const std::atomic<bool>& cancel = never_cancelled);

}  // namespace cascade
