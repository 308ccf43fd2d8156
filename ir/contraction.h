// Contraction: makes kernels faster by fusing products with sums, so that each pair rounds only
// once, and by multiplying with reciprocals instead of dividing.
//
// The contracted kernel may give other results than the original, but all executors still give the
// same bits for it. Whether a sum is contracted depends only on the two values that it adds, so
// equal formulas are contracted in the same way everywhere. Code that relies on the rounding of a
// product excludes that product (KernelBuilder::keep). Exact products need no exclusion, because
// fusing them changes no bit.
#pragma once

#include "ir/cell_kernel.h"

namespace cascade {

/// Contracts a kernel. The division of a varying number by a uniform number becomes a
/// multiplication by the reciprocal. A sum or difference with a varying product as an operand
/// becomes a multiply_add. If both operands are varying products, the first product is fused,
/// unless only the second product has a uniform factor. Requires a processor with multiply_add
/// (ir/multiply_add.h).
CellKernel contracted(const CellKernel& kernel);

}  // namespace cascade
