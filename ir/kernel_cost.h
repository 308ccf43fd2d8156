// The cost of a kernel, counted from its instructions.
//
// An operation is one instruction of arithmetic, comparison, logic or selection on the word of a
// cell. Two kinds of values are not counted: uniform values, which are computed once per call, and
// negations that are part of a multiply-add. A Laplacian counts as the operations that compute it:
// in two dimensions, three sums of neighbours, a product and a difference. A load is a value read
// from memory. A value that is read several times counts once. For example, a Laplacian has five
// loads, and reading the cell's own value in the same kernel adds no load. Values of links count
// once for each link in each loop over links.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// The cost of computing one cell.
struct KernelCost {
    double operations = 0;  ///< All operations, including divisions and roots.
    /// The divisions and square roots, which take longer than other operations.
    double divisions = 0;
    double loads = 0;  ///< Loaded values, masks, link indices and link weights.
    double stores = 0;
    double load_bytes = 0;  ///< The bytes of all loads.
    double store_bytes = 0;
    /// The part of `load_bytes` that loads the indices and weights of links.
    double link_bytes = 0;

    KernelCost& operator+=(const KernelCost& other);
};

/// The cost per cell. `links` is the average number of links per cell, including padding, and is
/// ignored on grids.
KernelCost cost_of(const CellKernel& kernel, Stencil stencil, double links);

}  // namespace cascade
