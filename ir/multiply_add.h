// a · b + c with one rounding: whether the processor has it, and loops that use it.
//
// This build may be for any x86-64, where the C library computes it by a call a number. So the
// loops are compiled for processors that have the instruction, and taken where there is one.
#pragma once

#include "ir/block_loops.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// Does this processor compute a · b + c with one rounding in one instruction? What does not, is
/// given no kernels with a multiply_add.
bool has_multiply_add();

/// Is there a multiply_add in the kernel?
bool multiplies_and_adds(const CellKernel& kernel);

/// block_loop() of a multiply_add, by that instruction. Internal to ir/.
template <typename Number>
BlockLoop<Number> multiply_add_loop(unsigned scalar_operands);

}  // namespace cascade
