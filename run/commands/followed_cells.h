// The cells of a run in the form that the equations of steady states need
// (continuation/steady_problem.h).
#pragma once

#include "continuation/domain_cells.h"
#include "continuation/sparse_rows.h"
#include "run/simulation/simulation.h"

#include <functional>
#include <vector>

namespace cascade {

/// Describes the cells of a simulation's domain. The simulation must outlive the result.
continuation::DomainCells followed_cells(const Simulation& simulation);

/// Evaluates a formula in all positions of the grid. The column changes fastest. The formula may
/// also consist of a single leaf that reads a plane of a model or of a surface's metric.
std::vector<double> followed_values(const Simulation& simulation, std::uint32_t stage,
                                    const Formula& formula);

/// Packs the species of a stage into a vector: all species of the first cell, then all species of
/// the next cell, and so on.
continuation::Vector followed_state(const Simulation& simulation, std::uint32_t stage);

/// Replaces the species of a started stage by the values in a vector of followed_state().
void set_followed_state(Simulation& simulation, std::uint32_t stage,
                        const continuation::Vector& state);

}  // namespace cascade
