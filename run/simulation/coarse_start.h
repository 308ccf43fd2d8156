// Stages that start on coarser grids.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <span>

namespace cascade {

/// Runs a stage on its coarser grids, each starting from the result of the one before, and takes
/// the species from the last.
Result<StageEnd> run_on_coarser_grids(const Environment& environment, std::span<StageState> states,
                                      std::uint32_t stage, RunControl& control);

}  // namespace cascade
