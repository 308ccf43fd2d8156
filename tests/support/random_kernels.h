// Random cell kernels, by which executors are compared.
#pragma once

#include "ir/cell_kernel.h"
#include "ir/multiply_add.h"

#include <array>
#include <cstdint>
#include <string>

namespace cascade::test {

struct RandomKernelOptions {
    int operations = 40;  ///< About how many instructions are asked for.
    int results = 4;
    Precision precision = Precision::single;
    bool laplacians = true;  ///< And neighbours.
    bool links = false;      ///< For linked cells: sums over links, and no neighbours.
    bool multiply_adds = has_multiply_add();
    int composed_percent = 5;  ///< Share of elementary functions, clamps, random numbers.
};

/// A valid kernel of random operations on random values, some of them constants that are likely to
/// be trouble. A pure function of its arguments. The bits of a NaN have no meaning, so operations
/// on words are given none that came out of arithmetic.
CellKernel random_kernel(std::uint64_t seed, const RandomKernelOptions& options = {});

/// How often each operation of the table occurred in kernels.
struct OperationCounts {
    std::array<std::uint64_t, static_cast<std::size_t>(op_count)> counts{};

    void add(const CellKernel& kernel);
    /// Names of the operations that never occurred in kernels for a grid, or for linked cells,
    /// separated by spaces.
    std::string missing(bool links = false) const;
    /// A line an operation: its count and its name.
    std::string report() const;
};

}  // namespace cascade::test
