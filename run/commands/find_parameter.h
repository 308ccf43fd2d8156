// Finds the parameter that an option names.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"

#include <cstdint>
#include <string_view>

namespace cascade {

/// The parameter with this name, such as "feed", in a stage. The name of the stage or its system
/// may precede the parameter's name. Fails if there is no such parameter, or if its value differs
/// from cell to cell.
Result<ItemId> find_parameter(const Program& program, std::uint32_t stage, std::string_view name);

}  // namespace cascade
