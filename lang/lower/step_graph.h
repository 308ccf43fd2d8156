// The expressions of a stage's step, lowered (internal to lowering).
#pragma once

#include "lang/lower/plan_builder.h"

#include <cstdint>
#include <vector>

namespace cascade::lowering {

/// All formulas of a stage's step. Every plan of the step numbers their nodes alike.
struct StepGraph {
    PlanGraph graph;
    IdVector<ItemId, NodeId> rates;
    std::vector<NodeId> bounds;  ///< By invariant.
    /// By row and column: the derivative of a species' rate by another species in the cell. Empty
    /// unless the solver needs them.
    IdVector<SpeciesId, std::vector<NodeId>> derivatives;
    std::vector<NodeId> step_invariants;  ///< The values that are computed once.

    StepGraph(const Program& program, std::uint32_t stage, const PlanOptions& options);
};

}  // namespace cascade::lowering
