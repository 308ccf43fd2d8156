// Values that describe the position of a cell. Functions of position are computed from them
// (internal to lowering).
#pragma once

#include "ir/space.h"
#include "lang/lower/kernel_assembly.h"

namespace cascade::lowering {

/// The position of the cell at an offset from the present cell.
class CellPlace {
public:
    CellPlace(KernelAssembly& assembly, Offset at)
        : assembly_(assembly), builder_(assembly.builder()), at_(at) {}

    ValueId builtin(Builtin builtin);
    ValueId of_model(ModelPlane plane) { return assembly_.field(plane, at_); }
    Space space();
    /// The length, area or volume of the cell in the script's units; 1 for a cell that crawls.
    ValueId content();
    /// The draw word of the cell's random numbers: the step's word `draw`, changed in all slices
    /// but the first.
    ValueId draw(ValueId draw);

private:
    Space space_of_tissue();
    ValueId number(int axis);
    ValueId coordinate(int axis, std::int64_t side);

    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    Offset at_;
};

}  // namespace cascade::lowering
