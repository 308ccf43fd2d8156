// Loops that apply one operation to a block of cells.
//
// Internal to ir/.
#pragma once

#include "ir/cell_kernel.h"

#include <cstdint>

namespace cascade {

/// Computes `count` words. Operands are words in the form of floats; a scalar operand is one word
/// that all cells share. `out` overlaps no operand.
using BlockLoop = void (*)(float* out, const float* a, const float* b, const float* c,
                           std::int64_t count);

/// The loop of an operation that depends on its operands alone. Bit k of `scalar_operands` says
/// that operand k is a scalar; at least one operand is not.
BlockLoop block_loop(Op op, unsigned scalar_operands);

}  // namespace cascade
