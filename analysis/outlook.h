// Says why a stage will stay uniform, if that is certain before the stage runs.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade::analysis {

/// The reason as one clause, such as "no wave grows from its flat state …". Empty if a wave may
/// grow, and for stages that do not start with weak noise around a flat state.
std::optional<std::string> why_nothing_grows(const Program& program, std::uint32_t stage);

}  // namespace cascade::analysis
