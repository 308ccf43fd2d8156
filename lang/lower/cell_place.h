// The place of a cell, from which functions of the place are computed (internal to lowering).
#pragma once

#include "ir/space.h"
#include "lang/lower/kernel_assembly.h"

namespace cascade::lowering {

/// The place of the cell at an offset.
class CellPlace {
public:
    CellPlace(KernelAssembly& assembly, Offset at)
        : assembly_(assembly), builder_(assembly.builder()), at_(at) {}

    ValueId builtin(Builtin builtin);
    ValueId of_model(ModelPlane plane) { return assembly_.field(plane, at_); }
    Space space();
    /// The length, area or volume of the cell in units; 1 of one that crawls.
    ValueId content();
    /// The draw of the cell, a word of 32 bits.
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
