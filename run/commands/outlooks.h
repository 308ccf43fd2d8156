// Predictions of the equations before a run.
#pragma once

#include "lang/program/program.h"
#include "run/script/script.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// Warnings that follow from the equations before a run. There is one for each stage of fields
/// whose start cannot lead to a pattern or whose diffusion is negative, such as "stage 'a': nothing
/// will grow: no wave grows from …".
std::vector<std::string> outlooks(const Script& script);
/// The warning for the stage number `stage`. Empty if there is none.
std::string outlook(const Program& program, std::uint32_t stage);

}  // namespace cascade
