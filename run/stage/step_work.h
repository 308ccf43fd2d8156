// The cost of a step of a stage: operations, loads and stores, and bytes of memory traffic.
#pragma once

#include "ir/kernel_cost.h"
#include "solvers/step_problem.h"

#include <cstddef>

namespace cascade {

/// All numbers are per cell and step, unless stated otherwise.
struct StepWork {
    KernelCost cost;  ///< The sum over all passes and aggregates.
    /// In each pass, every plane that is read and every plane that is written counts once, wherever
    /// it is stored. Links of linked cells count, too. Cache lines that are fetched only to be
    /// overwritten do not count.
    double bytes = 0;
    /// Bytes of all planes, masks and links that a step uses, over all cells.
    double working_set = 0;
    double links = 0;  ///< Links of a cell, including unused ones that fill up slices. 0 on grids.
    std::size_t passes = 0;  ///< Passes in a step.
    /// Whether the step also filters waves. The work of filtering is not counted.
    bool has_waves = false;
};

/// The work of a step. All its passes must have a source.
StepWork work_of(const StepProblem& problem);

}  // namespace cascade
