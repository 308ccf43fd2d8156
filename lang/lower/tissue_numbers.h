// Vectors, frames and links of cells that crawl as numbers of an expression graph (internal to
// lowering).
#pragma once

#include "lang/lower/graph_passes.h"

#include <array>
#include <cstdint>

namespace cascade::lowering {

/// Adds nodes to a graph of a stage of cells that crawl.
class TissueNumbers {
public:
    /// A number, or the three components of a vector.
    using Parts = std::array<NodeId, 3>;

    TissueNumbers(ExpressionGraph& graph, const PassContext& context);

    NodeId number(double value) { return graph_.number(value); }
    NodeId sum(NodeId a, NodeId b) { return graph_.call(Function::add, {a, b}); }
    NodeId difference(NodeId a, NodeId b) { return graph_.call(Function::subtract, {a, b}); }
    NodeId times(NodeId a, NodeId b) { return graph_.call(Function::multiply, {a, b}); }
    NodeId quotient(NodeId a, NodeId b) { return graph_.call(Function::divide, {a, b}); }
    NodeId larger(NodeId a, NodeId b) { return graph_.call(Function::max, {a, b}); }
    NodeId less(NodeId a, NodeId b) { return graph_.call(Function::less, {a, b}); }
    NodeId choice(NodeId c, NodeId a, NodeId b) { return graph_.call(Function::if_, {c, a, b}); }

    NodeId dot(const Parts& a, const Parts& b);
    Parts cross(const Parts& a, const Parts& b);
    NodeId length(const Parts& v) { return graph_.call(Function::sqrt, {dot(v, v)}); }
    Parts unit(const Parts& v);

    /// Three items that follow each other.
    Parts items(ItemId first);
    Parts place() { return items(rules_.place); }
    /// An axis of the cell's frame: 0 is ex, 1 ey, 2 ez.
    Parts axis(std::size_t axis);

    // Of a link.
    /// The value of a plane at the other end; a number is the same there.
    NodeId theirs(NodeId plane);
    /// From the cell to its neighbour, on periodic planes to the nearest image of it.
    Parts apart();
    NodeId distance() { return length(apart()); }
    Parts direction() { return unit(apart()); }
    NodeId gap() { return difference(distance(), radii()); }
    NodeId overlap();
    NodeId contact();
    NodeId is_touching() { return less(distance(), times(number(rules_.reach), radii())); }

private:
    NodeId radii();
    NodeId nearest(NodeId apart, double period);

    ExpressionGraph& graph_;
    const PassContext context_;
    const CellRules& rules_;
};

}  // namespace cascade::lowering
