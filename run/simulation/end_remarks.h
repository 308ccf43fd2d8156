// Remarks on a stage that has ended.
#pragma once

#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// A remark of one sentence on the result of a stage. Empty if the result needs no remark or if the
/// stage has not ended.
std::string remark_on(const Simulation& simulation, std::uint32_t stage);

/// Whether the stage itself has made the pattern that it shows. This is so if neighbouring cells
/// affect each other's rates, if neither random numbers nor varying parameters affect rates, and
/// if, for every species that is not uniform, cells differ far more than at the start of the stage.
bool made_its_pattern(const Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
