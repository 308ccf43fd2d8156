// Step-invariants: nodes of rates that no step changes and that are computed once (internal to
// lowering).
#pragma once

#include "lang/lower/plan_graph.h"

#include <span>
#include <vector>

namespace cascade::lowering {

/// The nodes, in their order, that a stage computes before its first step and reads in every step.
/// They depend on nothing that changes while the stage runs: sines of a direction that varies,
/// entries of its tensor, functions of the place, of files and of the metric. Aggregates become
/// numbers. Values that vary become planes, chosen to minimise the cost of a step: its remaining
/// operations plus the reading of the planes. `roots` are needed in every step.
std::vector<NodeId> step_invariant_nodes(const PlanGraph& graph, std::span<const NodeId> roots);

/// All step-invariant nodes that vary or are aggregates, except planes, and that other nodes read,
/// so that the remaining nodes do not depend on the place.
std::vector<NodeId> largest_step_invariants(const PlanGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade::lowering
