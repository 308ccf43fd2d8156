// Divides a kernel of many results into parts of a few results. Each part becomes a function.
//
// A single loop for 64 species needs 64 rates, 64 values and 64 addresses at once, which is far
// more than there are registers, and reads hundreds of rows side by side. Separate loops for parts
// of 8 results together take half to two thirds of the single loop's time. A value that several
// parts need is computed in each of these parts. So a kernel is not divided if computing such
// values would be a large part of the work.
#pragma once

#include "ir/cell_kernel.h"

#include <cstddef>
#include <vector>

namespace cascade {

/// The largest number of results of a part. A kernel with at most this number of results is never
/// divided.
inline constexpr std::size_t most_results_of_a_part = 8;

struct KernelPart {
    CellKernel kernel;  ///< The part's code. It has all slots of the whole kernel.
    /// For each result of the part, its index in the whole kernel.
    std::vector<std::size_t> results;
    /// Whether the instructions of each result precede those of the next result, so that each
    /// result can be stored before the next result is computed.
    bool is_in_order = false;
};

/// The parts of a kernel, at least one. Each result is in exactly one part. The parts may run in
/// any order or in parallel, because no result overwrites inputs of another result
/// (KernelArgumentsOf).
std::vector<KernelPart> parts_of(const CellKernel& kernel);

/// The size of a kernel, as a measure of its compile time: the number of its instructions, plus the
/// number of neighbours that they load.
std::size_t size_of(const CellKernel& kernel);

}  // namespace cascade
