// The parts of a system's rates that depend on time alone.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// The largest parts of a stage's rates that read `t` and otherwise only constants. They are the
/// same in all cells and independent of the species. In u' = exp(-(t - 50)^2) * sx - u this is the
/// exponential.
std::vector<Formula> parts_of_time(const Program& program, std::uint32_t stage);

}  // namespace cascade
