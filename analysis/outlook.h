// Why a stage will stay uniform, where that is certain before it runs.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade::analysis {

/// One clause, such as "no wave grows from its flat state …". Judges only a stage that starts with
/// weak noise about a flat state. Empty for others, and where a wave may grow.
std::optional<std::string> why_nothing_grows(const Program& program, std::uint32_t stage);

}  // namespace cascade::analysis
