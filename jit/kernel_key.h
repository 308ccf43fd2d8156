// What decides the code of a kernel, as bytes: equal bytes, equal code.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// The part of a key that a kernel, without its names, and its shape decide.
std::string kernel_key(const CellKernel& kernel, const KernelShape& shape);

/// The part that all else decides: this build, LLVM, the processor, the optimisation level. Empty
/// if one of them is not known, so that nothing may be kept for later processes.
std::string environment_key(int optimise);

}  // namespace cascade
