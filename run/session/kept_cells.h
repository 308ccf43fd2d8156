// Cells that crawl, kept at one moment, and a changed stage that goes on with them.
#pragma once

#include "run/session/kept_state.h"

#include <cstdint>

namespace cascade {

/// Gives a started stage of a changed program the cells that were kept: quantities take the values
/// of those of the same name. Those that have none start where the cells are now, and so do
/// parameters that were not painted and whose start gives other values than in `before` (may be
/// null). A value that starts again after a division is left to divisions. Fails if a quantity has
/// no value and cannot start.
Result<void> go_on_with_cells(Simulation& simulation, const Simulation* before, std::uint32_t stage,
                              const KeptStage& kept, const StageMoment& moment);

}  // namespace cascade
