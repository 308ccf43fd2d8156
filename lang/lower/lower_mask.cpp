// Reading around a cell where not all cells of the grid belong to the domain.
//
// Nothing flows through the border of a mask, as through a `noflux` side: where a cell beside lies
// outside, the cell itself stands in for it. What stands in for a diagonal neighbour is what would
// be found there on the small grid of a rectangle: the one inside of the two that lie between; the
// mean of both where both are, which is the corner that a border turns around; the cell itself
// where neither is. Cells outside hold no values that anything inside depends on.
#include "lang/lower/lower_pass.h"

namespace cascade::lowering {

ValueId NodeValues::chosen(Offset inside, ValueId value, ValueId otherwise) const {
    return builder_.select(assembly_.inside(inside), value, otherwise);
}

/// The value of the cell that is a step along an axis from the one at `from`, or what stands in.
ValueId NodeValues::beside(NodeId id, Offset from, Offset step) const {
    const ValueId value = number_at(id, from + step);
    if (!graph_.has_mask() || graph_.is_uniform(id)) return value;
    return chosen(from + step, value, number_at(id, from));
}

/// The value at an offset from the own cell, or what stands in.
ValueId NodeValues::beside(NodeId id, Offset offset) const {
    const ValueId value = number_at(id, offset);
    if (!graph_.has_mask() || graph_.is_uniform(id) || offset.is_own()) return value;
    const ValueId own = number_at(id, {});
    const Offset along_x{offset.dx, 0, 0}, along_y{0, offset.dy, 0}, along_z{0, 0, offset.dz};
    const Offset first = along_x.is_own() ? along_y : along_x;
    const Offset second = along_z.is_own() ? along_y : along_z;
    if (first == offset || second == offset) return chosen(offset, value, own);
    const ValueId a = number_at(id, first), b = number_at(id, second);
    const ValueId mean = scaled(builder_.add(a, b), 0.5);
    const ValueId between = chosen(first, chosen(second, mean, a), chosen(second, b, own));
    return chosen(offset, value, between);
}

ValueId NodeValues::entry_beside(NodeId tensor, std::size_t entry, Offset offset) const {
    const ValueId value = at(tensor, offset)[entry];
    if (!graph_.has_mask() || offset.is_own()) return value;
    return chosen(offset, value, at(tensor, {})[entry]);
}

}  // namespace cascade::lowering
