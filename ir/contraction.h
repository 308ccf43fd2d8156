// Fewer roundings, for speed: products that are added in the same operation, and reciprocals.
//
// A kernel of a meaning of its own comes out of it, so that all executors go on to agree. What
// becomes of a sum depends on nothing but the two values that it adds: so the same formula is
// contracted the same way wherever it is computed. What an algorithm needs as it is, is marked
// (KernelBuilder::keep); products that are exact may be contracted, for their bits stay.
#pragma once

#include "ir/cell_kernel.h"

namespace cascade {

/// The kernel with fewer roundings. A number that differs between cells and is divided by one that
/// does not is multiplied by the reciprocal of that one. A sum or difference of which one side is a
/// product that differs between cells becomes a multiply_add. Of two such products the one with a
/// factor that is the same in all cells is taken, else the second. For processors that have the
/// operation (ir/multiply_add.h).
CellKernel contracted(const CellKernel& kernel);

}  // namespace cascade
