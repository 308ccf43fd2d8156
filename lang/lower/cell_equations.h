// Writes instructions that solve linear equations in each cell (internal to lowering).
#pragma once

#include "ir/builder.h"

#include <vector>

namespace cascade::lowering {

/// Whether the value is known to be 0 in all cells.
bool is_zero(const KernelBuilder& builder, ValueId value);

/// Solves n equations Σ_j rows[i][j] x_j = rows[i][n] by Gaussian elimination with partial
/// pivoting. Returns x. The code has no branches: rows are exchanged by select instructions.
/// Coefficients that are known to be 0 need no instructions. If the equations are singular, the
/// results are not finite.
std::vector<ValueId> solve_equations(KernelBuilder& builder,
                                     std::vector<std::vector<ValueId>> rows);

}  // namespace cascade::lowering
