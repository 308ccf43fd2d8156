// Step-invariants: nodes of rates that have the same value in all steps and are computed once per
// stage (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"

#include <span>
#include <vector>

namespace cascade::lowering {

/// The nodes that a stage should compute before its first step and read in every step, in order.
/// They do not depend on anything that changes while the stage runs. Examples are sines of a
/// direction that varies by cell, entries of a tensor with this direction, and functions of
/// positions, files or the metric. Aggregates become numbers, and values that vary by cell become
/// planes. The nodes are chosen so that a step takes the least time for its remaining operations
/// and for reading these planes. `roots` are the nodes needed in every step.
std::vector<NodeId> step_invariant_nodes(const PlanGraph& graph, std::span<const NodeId> roots);

/// The nodes tensor_weights(…) that `roots` need. A stage always computes these nodes before its
/// first step, because no kernel can compute them.
std::vector<NodeId> tensor_weight_nodes(const PlanGraph& graph, std::span<const NodeId> roots);

/// The step-invariant nodes that are operands of nodes that change during the stage. Does not
/// include planes, or nodes that are the same in all cells, unless the latter are aggregates. Given
/// the values of all these nodes, no other node depends on position.
std::vector<NodeId> largest_step_invariants(const PlanGraph& graph, std::span<const NodeId> roots);

}  // namespace cascade::lowering
