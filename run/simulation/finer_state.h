// A stage's state in the finer cells of the same domain (internal to run/simulation).
#pragma once

#include "core/grid.h"
#include "run/domain/carried_cells.h"
#include "run/stage/stage_state.h"

#include <cstdint>

namespace cascade {

/// The state on the grid `finer`, each of whose cells is one of times × times parts of a cell of
/// `grid`. What is uniform stays. Has what regridded() keeps, and `frozen`.
StageState finer_state(const StageState& state, const CellCarrier& carrier, const Grid& grid,
                       const Grid& finer, std::int64_t times);

}  // namespace cascade
