// The loops over the rows and vectors of linked cells around a kernel's body.
//
// Internal to jit/. The arguments of the function are those of jit/skeleton.h and those of a
// LinkTable:
//
//     const uint32_t *starts, const int32_t *bases, const int16_t *offsets,
//     const float *weights, const float *gradient_x, const float *gradient_y, const float
//     *gradient_z
//
// of which those that no sum of the kernel asks for are not read.
#pragma once

#include "jit/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// Adds the function to `module`, whose data layout is already that of the target.
llvm::Function* build_linked_function(llvm::Module& module, const KernelPart& part,
                                      const KernelShape& shape, const std::string& name);

}  // namespace cascade
