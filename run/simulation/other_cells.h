// Runs stages in cells of the same domain that are larger or smaller than the script's cells.
#pragma once

#include "run/domain/cell_carrier.h"
#include "run/simulation/environment.h"
#include "run/simulation/simulation.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cascade {

/// The stages of a run in larger or smaller cells. A stage that no other stage reads is not
/// started.
struct StagesInOtherCells {
    std::unique_ptr<Environment> environment;
    std::vector<StageState> states;
};

/// The program of a script on a grid whose cells are `times` times as wide as in `fine`. The script
/// is checked again, so that everything that depends on lengths is correct. Lengths of stages with
/// a size are scaled as in `fine`.
Program coarser_program(const Script& script, const Program& fine, std::int64_t times);
/// The program in the cells in which a stage runs.
Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage);

/// An environment for `program`, which is the program of `known` in the cells to which `carrier`
/// carries. The domain must have no model, surface or mask. `account` may be null.
std::unique_ptr<Environment> environment_in_cells(const Environment& known, Program program,
                                                  const CellCarrier& carrier, TimeAccount* account);
/// An environment for `program`, which is the program of `fine` in larger cells. `account` may be
/// null.
std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, Program program,
                                             TimeAccount* account);

/// Carries the part of a state that other stages and pictures read: moment, numbers, planes, frozen
/// cells and sides. `spacing` is the width of the cells to which `carrier` carries.
StageState carried_state(const StageState& state, const CellCarrier& carrier, double spacing);
/// Carries the same part of a state to a grid whose cells are larger or smaller by an integer
/// factor.
StageState on_grid(const StageState& state, const Grid& from, const Grid& to);

/// Converts new values of an item from the cells of the domain to the cells of the stage. Where a
/// new value equals the present one (Simulation::field()), the stage's own value stays exactly as
/// it is.
Field in_cells_of(const Simulation& simulation, std::uint32_t stage, ItemId item, Field values);

/// Resets frozen cells to their values in `start`. `frozen` may be empty.
void keep_frozen(Field& values, const Mask& frozen, const Field& start);

/// A note for messages that name cells of a coarser grid. Empty on the domain's own grid.
std::string note_of_cells(const Program& program);

}  // namespace cascade
