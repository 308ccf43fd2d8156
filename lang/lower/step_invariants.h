// What no step of a stage changes: nodes of rates that are computed once (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"

#include <span>
#include <vector>

namespace cascade::lowering {

/// The nodes, in their order, that a stage computes before its first step and reads in every one.
/// They depend on nothing that changes while it runs: sines of a direction that varies, entries of
/// its tensor, functions of the place, of files and of the metric. Aggregates become numbers; what
/// varies becomes planes, chosen so that the steps take the fewest operations, those that are left
/// and the reading of the planes taken together. `roots` are needed in every step.
std::vector<NodeId> step_invariant_nodes(const PlanGraph& graph, std::span<const NodeId> roots);

/// All step-invariant nodes that vary or are aggregates, but for planes, of which other nodes are
/// made: so that what is left knows of no place.
std::vector<NodeId> largest_step_invariants(const PlanGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade::lowering
