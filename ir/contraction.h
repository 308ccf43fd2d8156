// Contraction: faster kernels by multiply-adds, rounded once, and multiplication by reciprocals.
//
// The result is a kernel with a new meaning, so that all executors still agree. Whether a sum is
// contracted depends only on the two values that it adds, so the same formula is contracted the
// same way everywhere. Algorithms exclude the products that must stay rounded
// (KernelBuilder::keep). Exact products may be contracted, because that preserves their bits.
#pragma once

#include "ir/cell_kernel.h"

namespace cascade {

/// Contracts a kernel. A varying number divided by a uniform one is multiplied by the reciprocal
/// instead. A sum or difference with a varying product on one side becomes a multiply_add. Of two
/// such products, the one with a uniform factor is fused, else the second. Requires a processor
/// with that operation (ir/multiply_add.h).
CellKernel contracted(const CellKernel& kernel);

}  // namespace cascade
