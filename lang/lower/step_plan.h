// Computations on planes, in order: passes over the grid, and reductions between them.
//
// Most formulas need one pass: every cell reads planes and writes its results. An operator whose
// operand contains an operator, as in lap(c^3 - c - lap(c)), needs more: one pass writes the inner
// part to a temporary plane, and a later one reads it at neighbours. Aggregates over the domain are
// computed between passes.
#pragma once

#include "ir/cell_kernel.h"
#include "ir/reduction.h"
#include "lang/program/program.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// Where the value of a kernel's slot comes from.
struct SlotSource {
    enum class Kind {
        item,       ///< Item `item` of stage `stage` (a field slot, a mask slot or a uniform slot).
        file,       ///< The array named Literals::texts()[item], as a field slot.
        image,      ///< The picture named Literals::texts()[item], as a field slot.
        attribute,  ///< The model's attribute Literals::texts()[item], as a field slot.
        texture,    ///< The picture painted on the model Literals::texts()[item], as a field slot.
        surface_value,   ///< Literals::surface_values()[item], as a field slot.
        metric,          ///< MetricPlane `item` of the surface, as a field slot.
        model,           ///< ModelPlane `item` of the cells of a model, as a field slot.
        neighbourhood,   ///< Which of the cells around are inside the mask, as a field slot of
                         ///< words.
        step_invariant,  ///< Step-invariant part `item` of stage `stage`: a field slot, or a
                         ///< uniform.
        step,            ///< Uniform: complete steps of the stage when the step begins.
        draw,         ///< Uniform: the number of that step as a word for draws (ir/draw_of_step.h).
        time,         ///< Uniform: the stage's t when the rates are evaluated.
        time_step,    ///< Uniform: the length of the current step.
        temporary,    ///< Temporary plane `item`, as a field slot.
        aggregate,    ///< Uniform: aggregate `item` of the plan.
        input,        ///< The stage's species `item` in input `stage` of a sweep, as a field slot.
        coefficient,  ///< Uniform: coefficient `item` of a sweep.
    };
    Kind kind = Kind::item;
    std::uint32_t stage = 0;
    std::uint32_t item = 0;
};

/// The kind of slot for a function that reads a text (field, image, attr, uvimage).
SlotSource::Kind slot_of_text(Function function);

/// Is it the kind of a slot that a text names?
constexpr bool is_of_text(SlotSource::Kind kind) {
    return kind >= SlotSource::Kind::file && kind <= SlotSource::Kind::texture;
}

/// A kernel, the sources of its slots and the targets of its results.
struct BoundKernel {
    CellKernel kernel;
    std::vector<SlotSource> fields;
    std::vector<SlotSource> masks;
    std::vector<SlotSource> uniforms;
    std::vector<std::uint32_t> results;  ///< Item numbers of the stage; empty for views.
};

/// The target of one result of a pass.
struct PassTarget {
    enum class Kind { result, temporary };
    Kind kind = Kind::result;
    std::uint32_t index = 0;   ///< Its number among the plan's results or temporaries.
    bool is_uniform = false;   ///< The same in all cells.
    Boundaries boundary = {};  ///< How the halo of a temporary or step-invariant part is filled.
};

/// An aggregate over the domain, computed from a plane.
struct Reduction {
    ReductionKind kind = ReductionKind::sum;
    SlotSource operand;           ///< An item, a file or a temporary.
    std::uint32_t aggregate = 0;  ///< Its number among the plan's aggregates.
};

struct Pass {
    std::vector<Reduction> reductions;  ///< Executed before the pass and after the one before it.
    BoundKernel bound;
    std::vector<PassTarget> targets;  ///< One for each result of the kernel.
};

struct StepPlan {
    std::vector<Pass> passes;            ///< The last one writes all results. Never empty.
    std::vector<std::uint32_t> results;  ///< Item numbers of the stage; empty for views.
    std::uint32_t result_count = 0;
    std::uint32_t temporaries = 0;  ///< Planes that passes write for later ones.
    std::uint32_t aggregates = 0;
    std::uint32_t step_invariants =
        0;                    ///< Step-invariant parts (plan_step_invariants) that it may read.
    bool is_uniform = false;  ///< Every result is the same in all cells.
    std::string words;        ///< The passes and the reasons for them, if requested.
};

/// Which operands of operators are written to a plane (materialised); the others are recomputed at
/// the neighbours where they are read. All choices give the same bits.
enum class Materialise : std::uint8_t {
    when_cheaper,  ///< Those that are more expensive to recompute than to write and read.
    never,         ///< Only those that cannot be recomputed.
    always,        ///< All that are not planes already.
};

struct PlanOptions {
    Materialise materialise = Materialise::when_cheaper;
    bool describe = false;  ///< Fill in StepPlan::words.
    /// Read step-invariant parts of rates, where that pays, from the results of
    /// plan_step_invariants(). The bits are the same as when every step computes them again.
    bool keeps_step_invariants = false;
};

}  // namespace cascade
