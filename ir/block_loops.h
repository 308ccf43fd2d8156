// Loops that apply one operation to a block of cells.
//
// Internal to ir/.
#pragma once

#include "ir/cell_kernel.h"

#include <cstdint>

namespace cascade {

/// Computes `count` words of `out`. The operands a, b and c are words, stored as float or double. A
/// scalar operand is a single word that all cells share. `out` overlaps no operand.
template <typename Number>
using BlockLoop = void (*)(Number* out, const Number* a, const Number* b, const Number* c,
                           std::int64_t count);

/// Returns the loop that applies `op`. The operation's result must depend only on its operands. If
/// bit k of `scalar_operands` is set, operand k is a scalar. At least one operand must not be a
/// scalar.
template <typename Number>
BlockLoop<Number> block_loop(Op op, unsigned scalar_operands);

}  // namespace cascade
