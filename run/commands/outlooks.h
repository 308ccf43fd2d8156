// Predicts from the equations, before a run, what will not grow.
#pragma once

#include "lang/program/program.h"
#include "run/script/script.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// Returns warnings that follow from the equations before a run. There is a warning for each stage
/// of fields whose start cannot lead to a pattern or whose diffusion is negative, such as "stage
/// 'a': nothing will grow: no wave grows from …".
std::vector<std::string> outlooks(const Script& script);
/// Returns the warning for the stage number `stage`, or an empty string if there is no warning.
std::string outlook(const Program& program, std::uint32_t stage);

}  // namespace cascade
