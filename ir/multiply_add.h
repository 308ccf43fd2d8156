// a · b + c with one rounding: whether the processor has an instruction for it, and loops that use
// it.
//
// Code compiled for every x86-64 processor would have to call a function of the C library for each
// number. So these loops are compiled for processors with the instruction and run only on these
// processors.
#pragma once

#include "ir/block_loops.h"
#include "ir/cell_kernel.h"

namespace cascade {

/// Whether this processor has an instruction that computes a · b + c with one rounding. Without
/// this instruction, no kernel may contain a multiply_add.
bool has_multiply_add();

/// Whether the kernel has a multiply_add.
bool multiplies_and_adds(const CellKernel& kernel);

/// The loop for multiply_add. block_loop() returns the loops for other operations. Internal to ir/.
template <typename Number>
BlockLoop<Number> multiply_add_loop(unsigned scalar_operands);

}  // namespace cascade
