// The cost of a kernel, counted from its instructions.
//
// An operation is one instruction of arithmetic, comparison, logic or selection on the word of a
// cell. Two kinds of values are not counted: uniform values, which are computed once per call, and
// negations that are part of a multiply-add. A Laplacian counts the operations of its sum: in two
// dimensions three sums of neighbours, a product and a difference. A load is a value read from
// memory. A value that is read several times counts once: a Laplacian has five loads, and if the
// kernel also reads the cell's own value, this adds no load. Values of links count once for each
// link in each loop over links.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// The cost of computing one cell.
struct KernelCost {
    double operations = 0;  ///< Includes divisions and roots.
    double divisions = 0;   ///< The divisions and square roots, which take longer.
    double loads = 0;       ///< Loaded values, masks, and indices and weights of links.
    double stores = 0;
    double load_bytes = 0;  ///< The bytes of all loads.
    double store_bytes = 0;
    double link_bytes = 0;  ///< The part of `load_bytes` for indices and weights of links.

    KernelCost& operator+=(const KernelCost& other);
};

/// The cost per cell. `links` is the average number of links per cell, including padding. On grids
/// it is ignored.
KernelCost cost_of(const CellKernel& kernel, Stencil stencil, double links);

}  // namespace cascade
