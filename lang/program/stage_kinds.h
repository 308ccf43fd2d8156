// Distinguishes stages of fields from stages of crawling cells.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// Whether the stage's system is a block of cells. False if the system is not known yet.
bool is_of_cells(const Program& program, std::uint32_t stage);

bool has_stage_of_cells(const Program& program);
bool has_stage_of_fields(const Program& program);

/// The last stage of crawling cells before `stage`. nullopt if there is none. If `stage` has no
/// founders, it continues with the cells of that earlier stage.
std::optional<std::uint32_t> stage_of_cells_before(const Program& program, std::uint32_t stage);

/// The last stage of fields before `stage`. nullopt if there is none. If `stage` grows cells, names
/// in the formula for the colour of the skin below the cells refer to that earlier stage.
std::optional<std::uint32_t> stage_of_fields_before(const Program& program, std::uint32_t stage);

}  // namespace cascade
