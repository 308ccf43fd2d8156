// What a stage that starts on coarser grids needs of its program and of the stages before it.
#pragma once

#include "core/grid.h"
#include "lang/program/program.h"
#include "run/domain/input_files.h"
#include "run/stage/stage_state.h"

#include <cstdint>

namespace cascade {

/// The same program on a grid whose cells are `times` as wide. The stage takes times² as many
/// steps, or as long, as on the fine one: patterns need a time that grows with the square of their
/// lengths.
Program on_coarser_grid(const Program& program, std::uint32_t stage, std::int64_t times);

/// An earlier stage's values on a coarser grid, to be read by starting values.
StageState restricted(const StageState& fine, const Grid& fine_grid, const Grid& coarse_grid);

/// Files on a coarser grid.
InputFiles restricted(const InputFiles& fine, const Grid& fine_grid, const Grid& coarse_grid);

/// Takes the species of a stage from the same stage on a grid twice as coarse; cells that are
/// frozen keep their starting values.
void take_refined(StageState& fine, const Grid& fine_grid, StageState& coarse,
                  const Grid& coarse_grid);

}  // namespace cascade
