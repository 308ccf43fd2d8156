// The loops over the rows and vectors of a grid around a kernel's body.
//
// Internal to jit/. The function has the arguments of jit/skeleton.h, then `int64_t is_near`: not 0
// if the fields are in a near cache and need no prefetches. For grids of several slices two more
// follow, `int64_t slice_rows, int64_t slice`: row j of slice k is row k * slice_rows + j, and a
// call stays within one slice, so that the loops are the same as for a plane. If the shape fills
// columns, two more follow, `int64_t left_column, int64_t right_column`: the members of
// HaloColumns, or −1 twice to fill none. Neighbours are read up to one vector beside the computed
// cells.
#pragma once

#include "ir/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// Adds the function to `module`, whose data layout is already the target's.
llvm::Function* build_grid_function(llvm::Module& module, const KernelPart& part,
                                    const KernelShape& shape, const std::string& name);

}  // namespace cascade
