// Linear equations of a cell as instructions of its kernel (internal to lowering).
#pragma once

#include "ir/builder.h"

#include <vector>

namespace cascade::lowering {

/// Is it known to be 0 whatever the cell is?
bool is_zero(const KernelBuilder& builder, ValueId value);

/// The x of n equations Σ_j rows[i][j] x_j = rows[i][n], by Gaussian elimination with partial
/// pivoting: straight-line code, in which rows are exchanged by choices. What is known to be 0
/// costs no instruction. The result is not finite if the equations are singular.
std::vector<ValueId> solve_equations(KernelBuilder& builder,
                                     std::vector<std::vector<ValueId>> rows);

}  // namespace cascade::lowering
