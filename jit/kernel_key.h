// Keys of compiled kernels: bytes that contain all facts that determine the code. Equal keys mean
// equal code.
//
// Internal to jit/.
#pragma once

#include "jit/kernel_shape.h"

#include <string>

namespace cascade {

/// The part of a key that depends on a kernel (except its names) and on its shape.
std::string kernel_key(const CellKernel& kernel, const KernelShape& shape);

/// The part of a key that depends on everything else: this build, LLVM, the processor, the
/// optimisation level. Empty if one of these facts is unknown. Code must then not be stored for
/// later processes.
std::string environment_key(int optimise);

}  // namespace cascade
