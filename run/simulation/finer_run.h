// A run that goes on in finer cells of the same domain.
#pragma once

#include "core/result.h"
#include "run/domain/cell_carrier.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <span>

namespace cascade {

/// How long a stage settles in finer cells: this part of the time that it has taken.
inline constexpr double settling_part = 0.1;

/// Carries values from the cells of `from` to those of `here`, an environment of the same program
/// with divided cells (DomainSettings::detail). Both must outlive the result.
std::unique_ptr<CellCarrier> carrier_to_finer(const Environment& from, const Environment& here);

/// Makes a stage go on whose state, like those of the stages before it, has been carried to `here`:
/// its end is changed, and so is its step where the solver would else become unstable. Its start is
/// computed anew, so that places, files and earlier stages keep their outlines; what was drawn by
/// chance in each cell is carried. Fails as start_stage() does.
Result<void> settle_in_finer_cells(Environment& here, std::span<StageState> states,
                                   std::uint32_t stage);

}  // namespace cascade
