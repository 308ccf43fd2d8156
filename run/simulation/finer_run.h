// Continues a run in smaller cells of the same domain.
#pragma once

#include "core/result.h"
#include "run/domain/cell_carrier.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <span>

namespace cascade {

/// A stage runs in smaller cells for this fraction of the time that it took in the script's cells.
inline constexpr double settling_part = 0.1;

/// Transfers values from the cells of `from` to the cells of `here`, which has the same program
/// with divided cells (DomainSettings::detail). Both must outlive the result.
std::unique_ptr<CellCarrier> carrier_to_finer(const Environment& from, const Environment& here);

/// Lets a stage continue in the smaller cells of `here`. The states of this stage and of the stages
/// before it must have been transferred to these cells. Gives the stage a new end. Shortens its
/// steps if its solver would otherwise become unstable. Computes starting values again, so that
/// shapes, files and earlier stages have sharp outlines. Values that contain random numbers are not
/// computed again but transferred. Fails in the same cases as start_stage().
Result<void> settle_in_finer_cells(Environment& here, std::span<StageState> states,
                                   std::uint32_t stage);

}  // namespace cascade
