// The loops over the rows and vectors of linked cells, around a kernel's body.
//
// Internal to jit/. The function has the arguments of jit/skeleton.h, followed by the members of a
// LinkTable and three arguments for pairs of fields:
//
//     const uint32_t *starts, const int32_t *bases, const int16_t *offsets,
//     const float *weights, const float *gradient_x, const float *gradient_y,
//     const float *gradient_z, const uint16_t *filled,
//     float *pairs, int64_t first_of_pairs, int64_t end_of_pairs
//
// Arguments that the kernel does not need are not read. `pairs` is scratch memory, aligned to 64
// bytes, for copies of all pairs of fields (jit/field_pairs.h): two numbers for each of the
// elements first_of_pairs … end_of_pairs − 1. These elements must include all targets of the rows'
// links, and begin and end at multiples of PlaneLayout::row_pad.
#pragma once

#include "ir/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// Adds the function to `module`, which must have the target's data layout already.
llvm::Function* build_linked_function(llvm::Module& module, const KernelPart& part,
                                      const KernelShape& shape, const std::string& name);

}  // namespace cascade
