// Stages in wider or finer cells of the same domain.
#pragma once

#include "run/domain/cell_carrier.h"
#include "run/simulation/environment.h"
#include "run/simulation/simulation.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cascade {

/// The stages of a run in other cells. Stages that nothing reads have not started.
struct StagesInOtherCells {
    std::unique_ptr<Environment> environment;
    std::vector<StageState> states;
};

/// The program of `fine`, which is that of the script on a grid, for cells `times` as wide: checked
/// again, so that all that the checker derives from lengths is right, with the factors that sizes
/// have in `fine`.
Program coarser_program(const Script& script, const Program& fine, std::int64_t times);
/// The program in the cells in which a stage runs.
Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage);

/// An environment for `program`: the program of `known` in the cells to which `carrier` carries.
/// Neither domain has a model, a surface or a mask. `account` may be null.
std::unique_ptr<Environment> environment_in_cells(const Environment& known, Program program,
                                                  const CellCarrier& carrier, TimeAccount* account);
/// The same with wider cells.
std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, Program program,
                                             TimeAccount* account);

/// The part of a state that other stages and pictures read, in the cells to which `carrier`
/// carries. They are `spacing` wide. The part is its moment, numbers, planes, frozen cells and
/// sides.
StageState carried_state(const StageState& state, const CellCarrier& carrier, double spacing);
/// The same on a grid whose cells are a whole number of times as wide or as short.
StageState on_grid(const StageState& state, const Grid& from, const Grid& to);

/// New values of an item, given in the cells of the domain, in those of the stage. Where they are
/// those of Simulation::field(), the stage keeps its own.
Field in_cells_of(const Simulation& simulation, std::uint32_t stage, ItemId item, Field values);

/// Gives frozen cells the values that they had at the start of their stage. `frozen` may be empty.
void keep_frozen(Field& values, const Mask& frozen, const Field& start);

/// After messages that name cells of a coarser grid; empty on that of the domain.
std::string note_of_cells(const Program& program);

}  // namespace cascade
