// The loops over the rows and vectors of a grid around a kernel's body.
//
// Internal to jit/. The arguments of the function are those of jit/skeleton.h, then `int64_t
// is_near`: not 0 where the fields are in a near cache, so that nothing is fetched ahead. For grids
// of several slices two more follow, `int64_t slice_rows, int64_t slice`: row j of slice k is row k
// * slice_rows + j, and a call stays within one slice, so that the loops are those of a plane.
// Where the shape fills columns, two more follow, `int64_t left_column, int64_t right_column`:
// those of HaloColumns, or −1 twice to fill none. Neighbours are read up to one vector beside the
// cells that are computed.
#pragma once

#include "ir/kernel_parts.h"
#include "jit/kernel_shape.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// Adds the function to `module`, whose data layout is already that of the target.
llvm::Function* build_grid_function(llvm::Module& module, const KernelPart& part,
                                    const KernelShape& shape, const std::string& name);

}  // namespace cascade
