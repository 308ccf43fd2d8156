// What decides the code of a kernel, as bytes: equal bytes, equal code.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// Of the kernel itself (not of its names) and its shape.
std::string kernel_key(const CellKernel& kernel, const KernelShape& shape);

/// Of all else: this build, LLVM, the processor, how much is optimised. Empty where one of them is
/// not known, so that nothing may be kept for later processes.
std::string environment_key(int optimise);

}  // namespace cascade
