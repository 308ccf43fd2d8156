// Reads values at neighbours of a cell if some cells of the grid are outside the domain.
//
// The value of a neighbour outside the domain is replaced by the cell's value beyond the border.
// This is the cell's own value, as beyond a `noflux` side, or the value that (bordered) gives
// (border_pass.cpp). The value of a diagonal neighbour is replaced by the value that a rectangular
// grid would have there. If exactly one of the two cells between is inside, this is the value
// beyond the border of that cell. If both cells between are inside, so that the border turns a
// corner, it is the mean of their values beyond the border. If neither is inside, it is the present
// cell's value beyond two borders. Values of cells outside never affect cells inside.
#include "lang/lower/lower_pass.h"

namespace cascade::lowering {

namespace {

/// An operand of an operator: its node inside the mask, its node beyond the border, and its node
/// beyond two borders.
struct Read {
    NodeId inside, beyond, twice;
};

Read read_of(const PlanGraph& graph, NodeId id) {
    const Node& node = graph[id];
    if (!node.calls(Function::bordered)) return {id, id, id};
    return {node.operands[0], node.operands[1], node.operands[2]};
}

}  // namespace

ValueId NodeValues::chosen(Offset inside, ValueId value, ValueId otherwise) const {
    return builder_.select(assembly_.inside(inside), value, otherwise);
}

/// The value one step along an axis from the cell at `from`, or the value that takes its place.
ValueId NodeValues::beside(NodeId id, Offset from, Offset step) const {
    const auto [inside, beyond, twice] = read_of(graph_, id);
    const ValueId value = number_at(inside, from + step);
    if (!graph_.has_mask() || graph_.is_uniform(id)) return value;
    const ValueId next = chosen(from + step, value, number_at(beyond, from));
    if (from.is_own() || beyond == inside) return next;
    // If the cell at `from` is outside, the border is between this cell and the present cell.
    return chosen(from, next, beside(id, from + step));
}

/// The value at an offset from the present cell, or the value that takes its place.
ValueId NodeValues::beside(NodeId id, Offset offset) const {
    const auto [inside, beyond, twice] = read_of(graph_, id);
    const ValueId value = number_at(inside, offset);
    if (!graph_.has_mask() || graph_.is_uniform(id) || offset.is_own()) return value;
    const Offset along_x{offset.dx, 0, 0}, along_y{0, offset.dy, 0}, along_z{0, 0, offset.dz};
    const Offset first = along_x.is_own() ? along_y : along_x;
    const Offset second = along_z.is_own() ? along_y : along_z;
    if (first == offset || second == offset) return chosen(offset, value, number_at(beyond, {}));
    const ValueId a = number_at(beyond, first), b = number_at(beyond, second);
    const ValueId mean = scaled(builder_.add(a, b), 0.5);
    const ValueId between =
        chosen(first, chosen(second, mean, a), chosen(second, b, number_at(twice, {})));
    return chosen(offset, value, between);
}

}  // namespace cascade::lowering
