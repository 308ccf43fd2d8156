// Stages of cells that crawl (internal to the checker): the cells with which they start, what these
// bring with them, and when the stages end.
#pragma once

#include "lang/check/blocks/check_blocks.h"

#include <array>
#include <cstdint>
#include <optional>

namespace cascade::checking {

/// Checks a statement `founders: …`, `remove: e` or `body: e` of a stage of cells.
void check_cell_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        const Scope& scope);

/// Reports a solver or an end that a stage of cells cannot have, and fills in the rest of its time.
void fill_cell_time(Workspace& work, std::uint32_t stage, const Settings& own,
                    const Settings& defaults);
/// The same for a solver that an option asks for.
void change_cell_solver(Workspace& work, std::uint32_t stage, const TimeSettings& asked);

/// Gives the items of a stage of cells that have no value yet those of the cells that it goes on
/// with: place, frame, radius and age. `axes` are the stage's ey and ez, where it has them. Reports
/// a stage that has no cells.
void take_cells(Workspace& work, std::uint32_t stage, std::array<Formula, 2> axes);

/// Checks what is known with the whole stage: that the fields that its cells sense are of earlier
/// stages, and that distances of `near` are the same for all cells.
void check_cell_stage(Workspace& work, std::uint32_t stage);

}  // namespace cascade::checking
