// The cost of a step of a stage: operations, loads and stores, and bytes of memory traffic.
#pragma once

#include "ir/kernel_cost.h"
#include "solvers/step_problem.h"

#include <cstddef>

namespace cascade {

/// The work of a step. Numbers are per cell and step, unless stated otherwise.
struct StepWork {
    KernelCost cost;  ///< The sum over all passes and aggregates.
    /// In each pass, every plane that is read and every plane that is written counts once, wherever
    /// it is stored. Links of linked cells count, too. Cache lines that are fetched only to be
    /// overwritten do not count.
    double bytes = 0;
    /// The bytes of all planes, masks and links that a step uses, over all cells.
    double working_set = 0;
    /// The mean number of links of a cell, including unused links that fill up slices. 0 on grids.
    double links = 0;
    std::size_t passes = 0;  ///< The number of passes in a step.
    /// Whether the step also filters waves, convolves or solves constraints. This work is not
    /// counted.
    bool has_waves = false;
};

/// Counts the work of a step. All its passes must have a source.
StepWork work_of(const StepProblem& problem);

}  // namespace cascade
