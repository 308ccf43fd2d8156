// The loops over the rows and vectors of a grid around a kernel's body.
//
// Internal to jit/. The function that is built has this C signature:
//
//     void NAME(const float *const *fields, const unsigned char *const *masks,
//               const float *uniforms, float *const *results,
//               int64_t width, int64_t stride, int64_t row_begin, int64_t row_end);
//
// (of kernels of binary64 with double for float)
//
// and for grids of several slices two more arguments, `int64_t slice_rows, int64_t slice`.
//
// Pointers are to cell (0, 0, 0) of planes in the layout of PlaneLayout. Rows are rows of memory:
// row j of slice k is row k * slice_rows + j, and a call stays within one slice, so that the loops
// are those of a plane. Rows [row_begin, row_end) are computed in vectors of `lanes` cells; the last vector of a row may run into its padding, at most
// to the next multiple of PlaneLayout::row_pad. Neighbours are read up to one vector beside that.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

#include <llvm/IR/Module.h>

#include <string>

namespace cascade {

/// What decides the code of a kernel besides the kernel.
struct GridShape {
    Stencil stencil = Stencil::plane;
    int lanes = 16;  ///< Cells per vector: 4, 8 or 16; half as many of kernels of binary64.
};

/// The shape with vectors as wide as `lanes` cells of binary32.
inline GridShape shape_for(const CellKernel& kernel, Stencil stencil, int lanes) {
    return {stencil, kernel.precision == Precision::single ? lanes : lanes / 2};
}

/// Adds the function to `module`, whose data layout is already that of the target.
llvm::Function* build_grid_function(llvm::Module& module, const CellKernel& kernel,
                                    const GridShape& shape, const std::string& name);

}  // namespace cascade
