// Divides kernels of many results into parts, each of which becomes a function of a few results.
//
// A step of 64 species in one loop needs 64 rates, own values and addresses at once, far more than
// there are registers, and walks through hundreds of rows side by side. Parts of 8 results take
// half to two thirds of its time. Values needed by results of several parts are computed in each of
// these parts, so a kernel stays whole if they are most of its work.
#pragma once

#include "ir/cell_kernel.h"

#include <cstddef>
#include <vector>

namespace cascade {

/// Kernels with at most this number of results are never divided.
inline constexpr std::size_t most_results_of_a_part = 8;

struct KernelPart {
    CellKernel kernel;                 ///< Has the slots of the whole kernel.
    std::vector<std::size_t> results;  ///< By result of the part: its number in the whole kernel.
    /// The instructions of each result precede those of the next one, so that it can be stored at
    /// once.
    bool is_in_order = false;
};

/// The parts of a kernel, at least one, with each result in one of them. In parallel or in any
/// order, they compute the results of the kernel, since no result overwrites inputs of another one
/// (KernelArgumentsOf).
std::vector<KernelPart> parts_of(const CellKernel& kernel);

/// The size of a kernel by its compile time: the number of its instructions and of the loads of its
/// neighbours.
std::size_t size_of(const CellKernel& kernel);

}  // namespace cascade
