// Turns nodes of an expression graph into instructions, given the values of their operands
// (internal to lowering).
#pragma once

#include "lang/lower/cell_place.h"
#include "lang/lower/plan_graph.h"

#include <array>

namespace cascade::lowering {

/// A value in a cell: one number, the three numbers of a colour, or the three or six entries of a
/// tensor.
using Value = std::array<ValueId, 6>;

/// A node that is evaluated in the cell at an offset from the present cell.
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

/// The plane from which a node is read. The node must be in a plane before the first pass
/// (PlanGraph::is_plane).
PlaneSource plane_source(const PlanGraph& graph, NodeId id);

// The functions that lower particular kinds of calls.
Value lower_palette(KernelAssembly& assembly, const NodeInCell& node);
ValueId lower_shape(KernelAssembly& assembly, const NodeInCell& node);
ValueId lower_draw(KernelAssembly& assembly, const NodeInCell& node);

}  // namespace cascade::lowering
