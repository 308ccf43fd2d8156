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
    bool laplacians = true;  ///< Whether to use Laplacians and values of neighbours.
    /// Whether cells are linked, with sums over links instead of neighbours.
    bool links = false;
    /// Whether sums over links may read planes with a number for each link.
    bool link_planes = true;
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
    /// Names, separated by spaces, of the operations that never occurred. Operations that kernels
    /// for a grid, or with `links` kernels for linked cells, cannot contain are left out.
    /// `link_planes` has the same meaning as in RandomKernelOptions.
    std::string missing(bool links = false, bool link_planes = true) const;
    /// A line for each operation with its count and name.
    std::string report() const;
};

}  // namespace cascade::test
