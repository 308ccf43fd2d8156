// Remarks on a stage that has ended.
#pragma once

#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// A remark on a stage that has ended, in one sentence. Empty if the result is what it seems, and
/// for a stage that has not ended.
std::string remark_on(const Simulation& simulation, std::uint32_t stage);

/// Did the stage itself make the pattern that is there? True if its neighbours act on each other,
/// neither random numbers nor varying parameters act on them, and every species that is not even
/// differs far more between cells than at the start of the stage.
bool made_its_pattern(const Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
