// What a kernel costs, counted from its instructions.
//
// An operation is one instruction of arithmetic, comparison, logic or choice on the word of a cell:
// what is the same in all cells is computed once and not counted, nor is a sign that a multiply-add
// turns over. A Laplacian is as many operations as its sum has: in two dimensions three sums of
// neighbours, a product and a difference. A load is a value that comes from memory, the same one
// being loaded once: the five values of a Laplacian are five loads, and the cell's own value
// besides is none.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// Of one cell.
struct KernelCost {
    double operations = 0;  ///< Divisions and roots included.
    double divisions = 0;  ///< Those of them that are divisions or square roots, which take longer.
    double loads = 0;      ///< Of values, of a mask's bytes, of a link's place and weights.
    double stores = 0;
    double load_bytes = 0;  ///< Of all loads.
    double store_bytes = 0;
    double link_bytes = 0;  ///< Those of `load_bytes` that are places and weights of links.

    KernelCost& operator+=(const KernelCost& other);
};

/// `links` is how many links a cell has on average, those that fill up slices included; on grids it
/// means nothing.
KernelCost cost_of(const CellKernel& kernel, Stencil stencil, double links);

}  // namespace cascade
