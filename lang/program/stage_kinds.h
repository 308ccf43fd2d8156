// Distinguishes the stages of fields from the stages of cells that crawl.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// Whether the stage's system is a block of cells. False while its system is not known.
bool is_of_cells(const Program& program, std::uint32_t stage);

bool has_stage_of_cells(const Program& program);
bool has_stage_of_fields(const Program& program);

/// The last stage of cells before this stage. Empty if there is none. Unless this stage has
/// founders, it continues with the cells of that stage.
std::optional<std::uint32_t> stage_of_cells_before(const Program& program, std::uint32_t stage);

/// The last stage of fields before `stage`. Empty if there is none. If `stage` grows cells, the
/// formula for the colour of the skin below the cells reads names of that earlier stage.
std::optional<std::uint32_t> stage_of_fields_before(const Program& program, std::uint32_t stage);

}  // namespace cascade
