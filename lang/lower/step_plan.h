// Plans of computations on planes. A plan is a list of passes over the grid. Between passes there
// are reductions and operations that need whole planes.
//
// Most formulas need one pass, in which every cell reads planes and writes its results. An operator
// whose operand contains an operator, as in lap(c^3 - c - lap(c)), needs more passes: one pass
// writes the inner part to a temporary plane, and a later pass reads it at neighbours. Aggregates
// over the domain are computed between passes.
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

/// A kernel, the sources of its slots, and the items to which its results belong.
struct BoundKernel {
    std::shared_ptr<const CellKernel> kernel;  ///< Never null once the plan is complete.
    IdVector<FieldSlot, PlaneSource> fields;
    IdVector<MaskSlot, StageItem> masks;
    IdVector<UniformSlot, UniformSource> uniforms;
    std::vector<ItemId> results;  ///< Items of the stage; empty for views.
};

using ResultId = Id<struct ResultTag>;  ///< A result of a plan.

/// Where one result of a pass is written: to a plane or to a number.
struct PassTarget {
    std::variant<ResultId, TemporaryId> id;
    bool is_uniform = false;   ///< Whether the result is the same in all cells.
    Boundaries boundary = {};  ///< The rules that fill the halo of a temporary or step-invariant.
    /// If the result is a definition that has its own rules at sides, the index of these rules in
    /// Stage::definition_sides. These rules fill the halo, and `boundary` does not.
    std::optional<std::size_t> wall = {};
};

/// An aggregate over the domain, computed from a plane.
struct Reduction {
    ReductionKind kind = ReductionKind::sum;
    PlaneSource operand;
    AggregateId aggregate;
};

struct StepPlan;

/// A convolution convolve(…): for each cell, a weighted sum of values of the cells around it.
struct Convolution {
    PlaneSource operand;
    TemporaryId target;
    Boundaries boundary = {};  ///< The rules that fill the target's halo.
    /// The plan of the weights. It runs on a line of cells, each of which represents one lag
    /// (LagPart).
    std::shared_ptr<const StepPlan> weight;
    /// The plan that computes the largest distance of cells that count, as one number. If null, all
    /// cells of the domain count.
    std::shared_ptr<const StepPlan> reach;
};

/// The field u that satisfies a constraint `0 = e`. The expression e is L u + b with a linear
/// operator L. In the plan of e, Unknown is u. In the plan of L u, Unknown is the field to which L
/// is applied.
struct Solve {
    TemporaryId target;
    std::uint32_t constraint = 0;  ///< The index of the constraint in Literals.
    std::uint32_t stage = 0;
    Boundaries boundary = {};                ///< The rules that fill the target's halo.
    std::optional<std::size_t> wall = {};    ///< See PassTarget::wall.
    std::shared_ptr<const StepPlan> whole;   ///< The plan of e.
    std::shared_ptr<const StepPlan> linear;  ///< The plan of L u.
    /// The step-invariants of `linear`, which do not change with u. Null if there are none.
    std::shared_ptr<const StepPlan> parts;
};

struct Pass {
    /// Computed before the kernel of the pass: first `solves`, the fields of constraints, and then
    /// `convolutions`.
    std::vector<Solve> solves;
    std::vector<Convolution> convolutions;
    /// Computed after the constraints and convolutions and before the kernel.
    std::vector<Reduction> reductions;
    BoundKernel bound;
    std::vector<PassTarget> targets;  ///< Where each result of the kernel is written.
};

struct StepPlan {
    std::vector<Pass> passes;     ///< The last pass writes all results. Never empty.
    std::vector<ItemId> results;  ///< Items of the stage; empty for views.
    std::uint32_t result_count = 0;
    std::uint32_t temporaries = 0;  ///< The number of planes that passes write for later passes.
    std::uint32_t aggregates = 0;
    std::uint32_t step_invariants = 0;  ///< The number of step-invariants that the plan may read.
    /// In a plan of step-invariants, how many of them are weights of links by tensors. These
    /// step-invariants come last. For each of them, the plan has three results (γ and the two
    /// components of v), from which its plane is computed (TensorLinks::weights).
    std::uint32_t tensor_weights = 0;
    bool is_uniform = false;  ///< Whether every result is the same in all cells.
    std::string words;  ///< A description of the passes and of the reasons for them, if requested.
};

/// Which operands of operators are written to a plane (materialised). All other operands are
/// recomputed at the neighbours at which they are read. Every choice gives the same bits.
enum class Materialise : std::uint8_t {
    when_cheaper,  ///< Operands that are cheaper to write and read than to recompute.
    never,         ///< Only operands that cannot be recomputed.
    always,        ///< All operands that are not in planes already.
};

struct PlanOptions {
    Materialise materialise = Materialise::when_cheaper;
    bool describe = false;  ///< Whether to fill in StepPlan::words.
    /// Whether step-invariants of rates are read from the results of plan_step_invariants() if that
    /// takes less time than computing them in every step. The bits are the same.
    bool keeps_step_invariants = false;
};

}  // namespace cascade
