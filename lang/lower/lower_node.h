// Turns nodes of an expression graph into instructions, given the values of their operands
// (internal to lowering).
#pragma once

#include "lang/lower/cell_place.h"
#include "lang/lower/plan_graph.h"

#include <array>

namespace cascade::lowering {

/// A value in a cell: one number, the three numbers of a colour, or the three or six of a tensor.
using Value = std::array<ValueId, 6>;

/// A node to evaluate in the cell at an offset from the present cell.
struct NodeInCell {
    const PlanGraph& graph;
    NodeId id;
    Offset at;
    std::array<Value, most_operands> values{};  ///< The values of the node's operands.

    const Node& node() const { return graph[id]; }
    const Node& operand(std::size_t k) const { return graph[node().operands[k]]; }
    ValueId number(std::size_t k) const { return values[k][0]; }
};

/// The value of a node. The node must be neither an operator nor a vector.
Value lower_node(KernelAssembly& assembly, const NodeInCell& node);

/// For a node that is in a plane before the first pass (PlanGraph::is_plane): the plane from which
/// it is read.
PlaneSource plane_source(const PlanGraph& graph, NodeId id);

// Lower particular kinds of calls.
Value lower_palette(KernelAssembly& assembly, const NodeInCell& node);
ValueId lower_shape(KernelAssembly& assembly, const NodeInCell& node);
ValueId lower_draw(KernelAssembly& assembly, const NodeInCell& node);

}  // namespace cascade::lowering
