// Reads values around a cell if not all cells of the grid belong to the domain.
//
// Nothing flows through the border of a mask, as through a `noflux` side: a neighbour outside is
// replaced by the cell itself. A diagonal neighbour is replaced by what the small grid of a
// rectangle would have there: by the one inside of the two cells in between; by the mean of both if
// both are inside, where the border turns a corner; by the cell itself if neither is. No cell
// inside depends on the values of cells outside.
#include "lang/lower/lower_pass.h"

namespace cascade::lowering {

ValueId NodeValues::chosen(Offset inside, ValueId value, ValueId otherwise) const {
    return builder_.select(assembly_.inside(inside), value, otherwise);
}

/// The value of the cell one step along an axis from the cell at `from`, or of its replacement.
ValueId NodeValues::beside(NodeId id, Offset from, Offset step) const {
    const ValueId value = number_at(id, from + step);
    if (!graph_.has_mask() || graph_.is_uniform(id)) return value;
    return chosen(from + step, value, number_at(id, from));
}

/// The value at an offset from the cell itself, or its replacement.
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
