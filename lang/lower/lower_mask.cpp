// Reads values around a cell if not all cells of the grid belong to the domain.
//
// A neighbour outside is replaced by what lies beyond the border from the cell: by the cell itself,
// as beyond a `noflux` side, or by what (bordered) has for it (border_pass.cpp). A diagonal
// neighbour is replaced by what the small grid of a rectangle would have there: by what lies beyond
// the one inside of the two cells in between; by the mean of both if both are inside, where the
// border turns a corner; by what lies beyond the border twice if neither is. No cell inside depends
// on the values of cells outside.
#include "lang/lower/lower_pass.h"

namespace cascade::lowering {

namespace {

/// An operand of an operator: its values inside, and those beyond the border once and twice.
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

/// The value of the cell one step along an axis from the cell at `from`, or of its replacement.
ValueId NodeValues::beside(NodeId id, Offset from, Offset step) const {
    const auto [inside, beyond, twice] = read_of(graph_, id);
    const ValueId value = number_at(inside, from + step);
    if (!graph_.has_mask() || graph_.is_uniform(id)) return value;
    const ValueId next = chosen(from + step, value, number_at(beyond, from));
    if (from.is_own() || beyond == inside) return next;
    // The border runs between the cell and the one at `from`.
    return chosen(from, next, beside(id, from + step));
}

/// The value at an offset from the cell itself, or its replacement.
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
