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

/// The stages of a run in larger or smaller cells. A stage is started only if another stage reads
/// it.
struct StagesInOtherCells {
    std::unique_ptr<Environment> environment;
    std::vector<StageState> states;
};

/// Returns the program of a script on a grid whose cells are `times` times as wide as in `fine`.
/// The script is checked again, so that everything that depends on lengths is correct. The lengths
/// of stages with a size are scaled in the same way as in `fine`.
Program coarser_program(const Script& script, const Program& fine, std::int64_t times);
/// Returns the program with the cells in which a stage runs.
Program program_of_stage(const Script& script, const Program& program, std::uint32_t stage);

/// Makes an environment for `program`, which is the program of `known` with the cells to which
/// `carrier` transfers values. The domain must have no model, surface or mask. `account` may be
/// null.
std::unique_ptr<Environment> environment_in_cells(const Environment& known, Program program,
                                                  const CellCarrier& carrier, TimeAccount* account);
/// Makes an environment for `program`, which is the program of `fine` with larger cells. `account`
/// may be null.
std::unique_ptr<Environment> on_coarser_grid(const Environment& fine, Program program,
                                             TimeAccount* account);

/// Transfers the parts of a state that other stages and pictures read: moment, numbers, planes,
/// frozen cells and sides. `spacing` is the width of the cells to which `carrier` transfers values.
StageState carried_state(const StageState& state, const CellCarrier& carrier, double spacing);
/// Transfers the same parts of a state to a grid whose cells are larger or smaller by an integer
/// factor.
StageState on_grid(const StageState& state, const Grid& from, const Grid& to);

/// Converts new values of an item from the cells of the domain to the cells of the stage. If new
/// values equal the present values (Simulation::field()), the stage's own values there stay exactly
/// as they are.
Field in_cells_of(const Simulation& simulation, std::uint32_t stage, ItemId item, Field values);

/// Resets frozen cells to their values in `start`. `frozen` may be empty.
void keep_frozen(Field& values, const Mask& frozen, const Field& start);

/// Returns a note for messages that name cells of a coarser grid. Returns an empty string on the
/// domain's own grid.
std::string note_of_cells(const Program& program);

}  // namespace cascade
