// Checks stages of crawling cells (internal to the checker): the cells at the start, the values
// that these cells have from an earlier stage, and the end of the stage.
#pragma once

#include "lang/check/blocks/check_blocks.h"

#include <array>
#include <cstdint>
#include <optional>

namespace cascade::checking {

/// Sets the starting radius of a stage's cells from the stage's `size`.
void take_cell_size(Workspace& work, std::uint32_t index);
/// Checks a statement `founders: …`, `remove: e` or `body: e` of a stage of cells.
void check_cell_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope);

/// Sets the settings of time of a stage of cells. Reports a solver, or a setting for the end of the
/// stage, that such a stage cannot have.
void fill_cell_time(Workspace& work, std::uint32_t stage, const Settings& own,
                    const Settings& defaults);
/// Gives a stage of cells the solver of the option --solver. Reports a solver that such a stage
/// cannot have.
void change_cell_solver(Workspace& work, std::uint32_t stage, const TimeSettings& asked);

/// If a stage of cells continues with the cells of an earlier stage, takes their position, frame,
/// radius and age from the earlier stage, except for values that `stage` sets itself. `axes` are
/// the ey and ez of `stage`. An axis that `stage` does not set is empty. Reports a stage that has
/// no cells.
void take_cells(Workspace& work, std::uint32_t stage, std::array<Formula, 2> axes);

/// Checks what can be checked only when the whole stage is known: whether its cells read only
/// fields of earlier stages, and whether the distances of `near` are the same for all cells.
void check_cell_stage(Workspace& work, std::uint32_t stage);

}  // namespace cascade::checking
