// a · b + c with one rounding: whether the processor has it, and loops that use it.
//
// A build for any x86-64 would call the C library for each number. These loops are compiled for
// processors with the instruction, and used if it is present.
#pragma once

#include "ir/block_loops.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// Whether this processor computes a · b + c with one rounding in one instruction. Other processors
/// get no kernels with a multiply_add.
bool has_multiply_add();

/// Whether the kernel has a multiply_add.
bool multiplies_and_adds(const CellKernel& kernel);

/// block_loop() of a multiply_add, by that instruction. Internal to ir/.
template <typename Number>
BlockLoop<Number> multiply_add_loop(unsigned scalar_operands);

}  // namespace cascade
