// The loops over the rows and vectors of a grid, around a kernel's body.
//
// Internal to jit/. The function has the arguments of jit/skeleton.h, followed by `int64_t
// is_near`, which is not 0 if the fields are in a near cache and need no prefetches. For grids of
// several slices, `int64_t slice_rows, int64_t slice` follow. Row j of slice k is row k *
// slice_rows + j. All rows of a call are in one slice, so the loops are the same as for a plane. If
// the shape fills columns, `int64_t left_column, int64_t right_column` follow: the members of
// HaloColumns, or −1 twice to fill none. The function may read fields up to one vector before and
// after the computed cells.
#pragma once

#include "ir/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// Adds the function to `module`, which must have the target's data layout already.
llvm::Function* build_grid_function(llvm::Module& module, const KernelPart& part,
                                    const KernelShape& shape, const std::string& name);

}  // namespace cascade
