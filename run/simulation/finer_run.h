// A run that goes on in finer cells of the same domain.
#pragma once

#include "core/result.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <span>

namespace cascade {

/// How long a stage settles in finer cells: this part of the time that it has taken.
inline constexpr double settling_part = 0.1;

/// Carries the stages that have started in `from` to `here`, an environment of the same program
/// with divided cells (DomainSettings::detail), and makes `stage` go on there: its end is changed,
/// and so is its step where the solver would else become unstable. The start of `stage` is computed
/// anew, so that places, files and earlier stages keep their outlines; what was drawn by chance in
/// each cell is carried. Fails as start_stage() does.
Result<void> go_on_in_finer_cells(const Environment& from, std::span<const StageState> states,
                                  Environment& here, std::span<StageState> into,
                                  std::uint32_t stage);

}  // namespace cascade
