// What of a system's rates depends on the time alone.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The largest parts of a stage's rates that read `t` and are a function of it and of constants
/// alone: the same in all cells, whatever the species are. In u' = exp(-(t - 50)^2) * sx - u that
/// is the exponential.
std::vector<Formula> parts_of_time(const Program& program, std::uint32_t stage);

}  // namespace cascade
