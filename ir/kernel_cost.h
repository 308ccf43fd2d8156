// The cost of a kernel, counted from its instructions.
//
// An operation is one instruction of arithmetic, comparison, logic or selection on the word of a
// cell. Uniform values are computed once and not counted, nor are negations that a multiply-add
// includes. A Laplacian counts the operations of its sum: in two dimensions three sums of
// neighbours, a product and a difference. A load is a value from memory, counted once if it
// repeats: a Laplacian has five loads, and also reading the cell's own value adds none. Values
// computed for links count once for each link and loop over them.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// The cost per cell.
struct KernelCost {
    double operations = 0;  ///< Includes divisions and roots.
    double divisions = 0;   ///< The divisions and square roots, which take longer.
    double loads = 0;       ///< Values, bytes of masks, indices and weights of links.
    double stores = 0;
    double load_bytes = 0;  ///< The bytes of all loads.
    double store_bytes = 0;
    double link_bytes = 0;  ///< The part of `load_bytes` for indices and weights of links.

    KernelCost& operator+=(const KernelCost& other);
};

/// `links` is the average number of links per cell, including padding. Ignored on grids.
KernelCost cost_of(const CellKernel& kernel, Stencil stencil, double links);

}  // namespace cascade
