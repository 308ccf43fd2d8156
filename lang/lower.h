// Lowering: formulas of a checked program to cell kernels. Cannot fail.
//
// A stage becomes four kernels. At its start `uniform_start` computes the items that are the same
// everywhere (run on a grid of one cell) and `cell_start` those that vary; then `step` computes the
// new value of every species from the old step:
//
//     new = old + speed · rate, clamped by the invariants in order of writing; old where frozen.
//
// A view kernel computes a picture: one result (a number) or three (a colour).
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"
#include "lang/program.h"

#include <string>
#include <vector>

namespace cascade {

/// Where the value of a kernel's slot comes from.
struct SlotSource {
    enum class Kind {
        item,  ///< Item `item` of stage `stage` (a field slot, a mask slot or a uniform slot).
        file,  ///< The file named Program::texts[item], as a field slot.
        step,  ///< Uniform: complete steps of the stage when the step begins. (t is step × speed.)
    };
    Kind kind = Kind::item;
    std::uint32_t stage = 0;
    std::uint32_t item = 0;
};

/// A kernel, and what to put into its slots and where its results go.
struct BoundKernel {
    CellKernel kernel;
    std::vector<SlotSource> fields;
    std::vector<SlotSource> masks;
    std::vector<SlotSource> uniforms;
    std::vector<std::uint32_t> results;  ///< Item numbers of the stage; empty for views.
};

/// Kernel of the stage's uniform items, in their order. No field slots. May have no results.
BoundKernel lower_uniform_start(const Program& program, std::uint32_t stage);

/// Kernel of the items that vary. `frozen`, if it varies, is stored as a number like the others.
BoundKernel lower_cell_start(const Program& program, std::uint32_t stage);

/// Kernel of one explicit Euler step, one result per species. Where `frozen` varies it is a mask
/// slot; where it is the same everywhere it is not in the kernel at all, and the time loop takes no
/// steps if it is true.
BoundKernel lower_step(const Program& program, std::uint32_t stage);

/// Kernel of the rates alone, one result per species: dt-free right-hand sides, for stability.
BoundKernel lower_rates(const Program& program, std::uint32_t stage);

/// Kernel of a picture formula. A colour has three results: red, green, blue, 0..1, not clamped.
BoundKernel lower_view(const Program& program, const Formula& formula, std::uint32_t stage);

}  // namespace cascade
