// Stages on coarser grids of the same domain, for their whole run or at their start.
#pragma once

#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cascade {

/// A stage on a coarser grid, with what it reads of the stages before it.
struct CoarserStage {
    std::unique_ptr<Environment> environment;
    std::vector<StageState> states;
};

/// The program of `fine`, which is that of the script on a grid, for cells `times` as wide: checked
/// again, so that all that the checker derives from lengths is right, with the factors that sizes
/// have in `fine`.
Program coarser_program(const Script& script, const Program& fine, std::int64_t times);
/// The program in the cells in which a stage runs.
Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage);

/// An environment for a grid with cells `times` as wide as those of `fine`, which has straight axes
/// and no mask. `account` may be null.
std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, std::int64_t times,
                                             TimeAccount* account);

/// What other stages and pictures read of a state, on another grid of the same domain, whose cells
/// are a whole number of times as wide or as short. In wider cells it has the means of the cells
/// that they cover; shorter ones lie on the curves of core/between_cells.h. A cell is frozen if the
/// cell around it is, or half of the cells in it.
StageState on_grid(const StageState& state, const Grid& from, const Grid& to);

/// The field of an item of a stage, given in the cells of a finer grid, in those of `to`.
Field restricted_field(const Field& fine, const Grid& from, const Grid& to);
/// The same for `frozen`: 1 where half of the cells are not 0, else 0.
Field restricted_flags(const Mask& fine, const Grid& from, const Grid& to, Precision precision);

/// After messages that name cells of a coarser grid; empty on that of the domain.
std::string note_of_cells(const Program& program);

}  // namespace cascade
