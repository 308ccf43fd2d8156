// The lowered expressions of one step of a stage (internal to lowering).
#pragma once

#include "lang/lower/plan_builder.h"

#include <cstdint>
#include <vector>

namespace cascade::lowering {

/// All formulas of a stage's step. In every plan of the step, these formulas have the same node
/// numbers.
struct StepGraph {
    PlanGraph graph;
    IdVector<ItemId, NodeId> rates;
    /// The bounds of the invariants, in the order of System::invariants.
    std::vector<NodeId> bounds;
    /// derivatives[i][j] is the derivative of the rate of species i with respect to the value of
    /// species j in the same cell. Empty unless the solver needs derivatives.
    IdVector<SpeciesId, std::vector<NodeId>> derivatives;
    std::vector<NodeId> step_invariants;  ///< Nodes that are computed once per stage.
    /// How many nodes are tensor_weights(…). They are the last of `step_invariants`.
    std::uint32_t tensor_weights = 0;

    StepGraph(const Program& program, std::uint32_t stage, const PlanOptions& options);
};

}  // namespace cascade::lowering
