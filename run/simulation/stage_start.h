// The start of a stage: its parameters, its species and its sides.
#pragma once

#include "core/result.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_view.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <span>

namespace cascade {

/// Computes the items of a stage that are the same in all cells.
void start_uniform_items(const StageView& view, StageState& state);

/// Computes the starting values of a stage from earlier stages. Fails if `speed` is not above 0 or
/// a side with a flux lies where the surface is sheared.
Result<void> start_stage(const Environment& environment, std::span<StageState> states,
                         std::uint32_t stage);

}  // namespace cascade
