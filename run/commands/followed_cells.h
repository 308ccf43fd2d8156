// The cells of a run, as the equations of steady states need them (continuation/steady_problem.h).
#pragma once

#include "continuation/domain_cells.h"
#include "continuation/sparse_rows.h"
#include "run/simulation/simulation.h"

#include <functional>
#include <vector>

namespace cascade {

/// The cells of a simulation's domain. The simulation must outlive the result.
continuation::DomainCells followed_cells(const Simulation& simulation);

/// The values of a formula in all positions of the grid, x fastest. The formula may also consist of
/// a single leaf that reads a plane of a model or of a surface's metric.
std::vector<double> followed_values(const Simulation& simulation, std::uint32_t stage,
                                    const Formula& formula);

/// The species of a stage as a vector: all species of the first cell, then those of the next cell,
/// and so on.
continuation::Vector followed_state(const Simulation& simulation, std::uint32_t stage);

/// Replaces the species of a started stage by such a vector.
void set_followed_state(Simulation& simulation, std::uint32_t stage,
                        const continuation::Vector& state);

}  // namespace cascade
