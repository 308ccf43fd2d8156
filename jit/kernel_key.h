// The facts that determine the code of a kernel, as bytes: equal bytes, equal code.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// The part of a key that depends on a kernel, without its names, and on its shape.
std::string kernel_key(const CellKernel& kernel, const KernelShape& shape);

/// The part that depends on all else: this build, LLVM, the processor, the optimisation level.
/// Empty if one of them is unknown, so that no code may be stored for later processes.
std::string environment_key(int optimise);

}  // namespace cascade
