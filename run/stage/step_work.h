// What a step of a stage costs: operations, loads and stores, and bytes of memory traffic.
#pragma once

#include "ir/kernel_cost.h"
#include "solvers/step_problem.h"

#include <cstddef>

namespace cascade {

/// Per cell and step, unless stated otherwise.
struct StepWork {
    KernelCost cost;  ///< Of all passes and aggregates.
    /// Each pass counts the planes that it reads and those that it writes once, wherever they are
    /// stored, and the links of cells on no grid. Cache lines that are fetched before they are
    /// written do not count.
    double bytes = 0;
    double working_set =
        0;             ///< Bytes of all planes, masks and links that a step uses, in all cells.
    double links = 0;  ///< Links of a cell, with the padding of slices; 0 on grids.
    std::size_t passes = 0;  ///< Passes in a step.
    bool has_waves = false;  ///< The step also filters waves, which is not counted.
};

/// The work of a step, all of whose passes have a source.
StepWork work_of(const StepProblem& problem);

}  // namespace cascade
