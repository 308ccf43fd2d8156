// Loops that apply one operation to a block of cells.
//
// Internal to ir/.
#pragma once

#include "ir/cell_kernel.h"

#include <cstdint>

namespace cascade {

/// Computes `count` words. Operands are words as float or double. A scalar operand is one word that
/// all cells share. `out` overlaps no operand.
template <typename Number>
using BlockLoop = void (*)(Number* out, const Number* a, const Number* b, const Number* c,
                           std::int64_t count);

/// The loop of an operation that only depends on its operands. Bit k of `scalar_operands` says that
/// operand k is a scalar. At least one operand is not.
template <typename Number>
BlockLoop<Number> block_loop(Op op, unsigned scalar_operands);

}  // namespace cascade
