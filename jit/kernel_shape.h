// Facts that determine the code of a kernel in addition to the kernel itself.
//
// Internal to jit/.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

struct KernelShape {
    Stencil stencil = Stencil::plane;
    /// Cells per vector: 4, 8 or 16 in binary32, half as many in binary64.
    int lanes = 16;
    bool fills_columns = false;  ///< Whether the kernel copies columns to the halo.
    // Features of the processor, and operations that are fast on it. tuned() in
    // jit/target_machine.h sets them.
    bool has_multiply_add = false;  ///< One instruction computes a · b + c with one rounding.
    bool is_short_of_loads = false;
    bool has_fast_gathers = false;
    bool has_rounding = false;  ///< One instruction rounds to whole numbers.
    bool has_scaling = false;   ///< One instruction scales vectors of 64 bytes by powers of two.
};

/// The shape for vectors of `lanes` cells of binary32, or of half as many cells of binary64.
inline KernelShape shape_for(const CellKernel& kernel, Stencil stencil, int lanes) {
    return {stencil, kernel.precision == Precision::single ? lanes : lanes / 2};
}

}  // namespace cascade
