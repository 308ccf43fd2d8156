// What the start of a stage of cells that crawl would give the cells that are there now.
#pragma once

#include "run/simulation/environment.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Simulation::values_of_start().
std::vector<std::vector<double>> values_of_start(const Environment& environment,
                                                 std::span<const StageState> states,
                                                 std::uint32_t stage);

}  // namespace cascade
