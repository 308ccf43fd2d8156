// Values that describe the position of a cell, from which functions of position are computed
// (internal to lowering).
#pragma once

#include "ir/space.h"
#include "lang/lower/kernel_assembly.h"

namespace cascade::lowering {

/// The position of a cell, which is given by its offset from the present cell.
class CellPlace {
public:
    CellPlace(KernelAssembly& assembly, Offset at)
        : assembly_(assembly), builder_(assembly.builder()), at_(at) {}

    ValueId builtin(Builtin builtin);
    ValueId of_model(ModelPlane plane) { return assembly_.field(plane, at_); }
    Space space();
    /// The length, area or volume of the cell in the script's units; 1 for a crawling cell.
    ValueId content();
    /// The draw word for the cell's random numbers. In the first slice it is the step's word
    /// `draw`. In other slices the slice changes it.
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
