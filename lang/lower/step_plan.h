// Computations on planes, in order: passes over the grid, and between them reductions and
// operations that need whole planes.
//
// Most formulas need one pass: every cell reads planes and writes its results. An operator whose
// operand contains an operator, as in lap(c^3 - c - lap(c)), needs more: one pass writes the inner
// part to a temporary plane, and a later one reads it at neighbours. Aggregates over the domain are
// computed between passes.
#pragma once

#include "ir/cell_kernel.h"
#include "ir/reduction.h"
#include "lang/lower/slot_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A kernel, the sources of its slots and the targets of its results.
struct BoundKernel {
    std::shared_ptr<const CellKernel> kernel;  ///< Never null once the plan is complete.
    IdVector<FieldSlot, PlaneSource> fields;
    IdVector<MaskSlot, StageItem> masks;
    IdVector<UniformSlot, UniformSource> uniforms;
    std::vector<ItemId> results;  ///< Of the stage; empty for views.
};

using ResultId = Id<struct ResultTag>;  ///< A result of a plan.

/// The target of one result of a pass.
struct PassTarget {
    std::variant<ResultId, TemporaryId> id;
    bool is_uniform = false;   ///< The same in all cells.
    Boundaries boundary = {};  ///< How the halo of a temporary or step-invariant part is filled,
    /// unless it is a definition with sides of its own, by their number in
    /// Stage::definition_sides.
    std::optional<std::size_t> wall = {};
};

/// An aggregate over the domain, computed from a plane.
struct Reduction {
    ReductionKind kind = ReductionKind::sum;
    PlaneSource operand;
    AggregateId aggregate;
};

struct StepPlan;

/// convolve(…): weighted sums over the cells around each cell.
struct Convolution {
    PlaneSource operand;
    TemporaryId target;
    Boundaries boundary = {};  ///< How the target's halo is filled.
    /// The weights, on a line of cells that stand for lags (LagPart), …
    std::shared_ptr<const StepPlan> weight;
    /// … and the distance up to which cells count, a number; null: all cells of the domain count.
    std::shared_ptr<const StepPlan> reach;
};

/// The field that makes e of a constraint `0 = e` zero. e is L u + b with a linear operator L and
/// the field u. The plans read u, or what L is applied to, as Unknown.
struct Solve {
    TemporaryId target;
    std::uint32_t constraint = 0;  ///< Its number in Literals.
    std::uint32_t stage = 0;
    Boundaries boundary = {};                ///< How the target's halo is filled, …
    std::optional<std::size_t> wall = {};    ///< … as that of PassTarget.
    std::shared_ptr<const StepPlan> whole;   ///< e.
    std::shared_ptr<const StepPlan> linear;  ///< L u.
    /// What L does not change with u: the step-invariants of `linear`, which it reads; may be null.
    std::shared_ptr<const StepPlan> parts;
};

struct Pass {
    /// Executed before the pass and after the one before it: first constraints and convolutions, in
    /// order, …
    std::vector<Solve> solves;
    std::vector<Convolution> convolutions;
    std::vector<Reduction> reductions;  ///< … then these.
    BoundKernel bound;
    std::vector<PassTarget> targets;  ///< One for each result of the kernel.
};

struct StepPlan {
    std::vector<Pass> passes;     ///< The last one writes all results. Never empty.
    std::vector<ItemId> results;  ///< Of the stage; empty for views.
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
