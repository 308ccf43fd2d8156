// Runs stages on coarser grids before the stages start on their own grid.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <span>

namespace cascade {

/// Runs a stage on each of its coarser grids, the coarsest first. On each further grid, the stage
/// starts from the result on the grid before. The last result becomes the species of the stage.
Result<StageEnd> run_on_coarser_grids(const Environment& environment, std::span<StageState> states,
                                      std::uint32_t stage, RunControl& control);

}  // namespace cascade
