// Finds the parameter that an option names.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// The parameter of a stage with this name, such as "feed". The name of its stage or system may
/// precede the name. Fails if there is none, or if it differs from cell to cell.
Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view name);

}  // namespace cascade
