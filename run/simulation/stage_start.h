// Starts stages of fields, with their parameters, species and sides, and stages of crawling cells.
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

/// Computes the uniform items of a stage.
void start_uniform_items(const StageView& view, StageState& state);

/// Computes the starting values of a stage from earlier stages. Fails if `speed` is not above 0 or
/// if a side with a flux meets a sheared part of the surface. A stage of crawling cells also fails
/// in the same cases as start_tissue().
Result<void> start_stage(const Environment& environment, std::span<StageState> states,
                         std::uint32_t stage, const std::atomic<bool>& cancel = never_cancelled);

}  // namespace cascade
