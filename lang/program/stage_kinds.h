// Which stages of a program are of fields, and which of cells that crawl.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// Is its system a block of cells? False as long as its system is not known.
bool is_of_cells(const Program& program, std::uint32_t stage);

bool has_stage_of_cells(const Program& program);
bool has_stage_of_fields(const Program& program);

/// The last stage of cells before this one, whose cells it goes on with unless it has founders;
/// nothing if there is none.
std::optional<std::uint32_t> stage_of_cells_before(const Program& program, std::uint32_t stage);

/// The last stage of fields before this one, whose names the colour of the skin below cells reads;
/// nothing if there is none.
std::optional<std::uint32_t> stage_of_fields_before(const Program& program, std::uint32_t stage);

}  // namespace cascade
