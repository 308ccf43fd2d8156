// What a step of a stage costs: operations, loads and stores, bytes that go through memory.
#pragma once

#include "ir/kernel_cost.h"
#include "solvers/step_problem.h"

#include <cstddef>
#include <unordered_map>

namespace cascade {

/// Per cell and step, where nothing else is said.
struct StepWork {
    KernelCost cost;  ///< Of all passes and aggregates.
    /// Each pass reads the planes it reads once and writes those it writes once, from whatever
    /// memory; with the links of cells that lie on no grid. What a cache fetches of a line before
    /// it is written is not counted.
    double bytes = 0;
    double working_set =
        0;             ///< Bytes of all planes, masks and links that a step touches, in all cells.
    double links = 0;  ///< Of a cell, those included that fill up slices; 0 on grids.
    std::size_t passes = 0;  ///< In a step.
    bool has_waves = false;  ///< Waves are filtered besides, which is counted nowhere.
};

/// The kernels of a problem as what they were made of.
using KnownKernels = std::unordered_map<const Kernel*, CellKernel>;

/// The work of a step; every kernel of the problem is known.
StepWork work_of(const StepProblem& problem, const KnownKernels& kernels);

}  // namespace cascade
