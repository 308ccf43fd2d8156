// Random cell kernels for comparing executors.
#pragma once

#include "ir/cell_kernel.h"
#include "ir/multiply_add.h"

#include <array>
#include <cstdint>
#include <string>

namespace cascade::test {

struct RandomKernelOptions {
    int operations = 40;  ///< The approximate number of instructions.
    int results = 4;
    Precision precision = Precision::single;
    bool laplacians = true;   ///< Laplacians and values of neighbours.
    bool links = false;       ///< For linked cells: sums over links instead of neighbours.
    bool link_planes = true;  ///< Whether sums over links may read planes with a number for each.
    bool multiply_adds = has_multiply_add();
    int composed_percent = 5;  ///< Percentage of elementary functions, clamps and random numbers.
};

/// A valid kernel of random operations on random values, some of them constants that are likely to
/// cause trouble. A pure function of its arguments. The bits of a NaN have no meaning, so
/// operations on words never get a NaN that is the result of arithmetic.
CellKernel random_kernel(std::uint64_t seed, const RandomKernelOptions& options = {});

/// How often each operation of the table occurred in kernels.
struct OperationCounts {
    std::array<std::uint64_t, static_cast<std::size_t>(op_count)> counts{};

    void add(const CellKernel& kernel);
    /// Names of the operations that never occurred in kernels for a grid, or for linked cells,
    /// separated by spaces. `link_planes` is that of RandomKernelOptions.
    std::string missing(bool links = false, bool link_planes = true) const;
    /// A line for each operation with its count and name.
    std::string report() const;
};

}  // namespace cascade::test
