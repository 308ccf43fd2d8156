// The facts besides a kernel that determine its code.
//
// Internal to jit/.
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"

namespace cascade {

struct KernelShape {
    Stencil stencil = Stencil::plane;
    int lanes = 16;              ///< Cells per vector: 4, 8 or 16; half as many in binary64.
    bool fills_columns = false;  ///< See HaloColumns.
    // Features and strengths of the processor: see tuned() in jit/target_machine.h.
    bool has_multiply_add = false;  ///< With one rounding, in one instruction.
    bool is_short_of_loads = false;
    bool has_fast_gathers = false;
    bool has_rounding = false;  ///< Rounds to whole numbers in one instruction.
    bool has_scaling = false;   ///< Scales vectors of 64 bytes by powers of two in one instruction.
};

/// The shape with vectors as wide as `lanes` cells of binary32.
inline KernelShape shape_for(const CellKernel& kernel, Stencil stencil, int lanes) {
    return {stencil, kernel.precision == Precision::single ? lanes : lanes / 2};
}

}  // namespace cascade
