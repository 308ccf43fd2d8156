// Computes the lengths of a domain that grows, at the present moment of a stage.
#pragma once

#include "core/result.h"
#include "run/simulation/simulation.h"

#include <array>
#include <cstdint>
#include <optional>

namespace cascade {

/// Returns the lengths of a cell along x, y and z at the present time of a stage, in the script's
/// unit of length.
std::array<double, 3> cell_lengths(const Simulation& simulation, std::uint32_t stage);

/// Returns a failure if the domain of a stage shrinks to nothing within a few steps after `t`,
/// before the stage ends at `end`. Returns an empty optional if it does not. `step` is the length
/// of a step.
std::optional<Failure> shrinks_to_nothing(const SimulationDomain& domain, std::uint32_t stage,
                                          double t, double end, double step);

}  // namespace cascade
