// Remarks on a stage that has ended.
#pragma once

#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Returns a remark of one sentence on the result of a stage. Returns an empty string if the result
/// needs no remark or if the stage has not ended.
std::string remark_on(const Simulation& simulation, std::uint32_t stage);

/// Whether the stage itself has made the pattern that it shows. This is so if three conditions
/// hold. Neighbouring cells affect each other's rates. Neither random numbers nor varying
/// parameters affect rates. The cells of every species are uniform or differ far more than at the
/// start of the stage.
bool made_its_pattern(const Simulation& simulation, std::uint32_t stage);

}  // namespace cascade
