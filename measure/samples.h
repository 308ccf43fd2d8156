// A field as it is measured: plain numbers with the shape of their grid.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace cascade::measure {

/// One value per cell: columns run fastest, then rows, then slices. Cells whose value is not
/// finite lie outside of the domain and count for nothing.
struct Samples {
    std::array<std::size_t, 3> cells{1, 1, 1};       ///< Along x, y (downwards), z.
    std::array<bool, 3> periodic{true, true, true};  ///< Else the field is mirrored at the sides.
    double spacing = 1;                              ///< Side of a cell, in the unit of lengths.
    std::vector<double> values;

    std::size_t count() const { return values.size(); }
    /// How far apart neighbours along an axis lie in `values`.
    std::size_t stride(std::size_t axis) const {
        return axis == 0 ? 1 : axis == 1 ? cells[0] : cells[0] * cells[1];
    }
    /// Position along an axis.
    std::size_t position(std::size_t cell, std::size_t axis) const {
        return cell / stride(axis) % cells[axis];
    }
    /// The neighbour one step forwards or backwards along an axis; at a side that is mirrored the
    /// cell itself.
    std::size_t neighbour(std::size_t cell, std::size_t axis, bool forwards) const {
        const std::size_t at = position(cell, axis), last = cells[axis] - 1;
        if (forwards) {
            if (at < last) return cell + stride(axis);
            return periodic[axis] ? cell - last * stride(axis) : cell;
        }
        if (at > 0) return cell - stride(axis);
        return periodic[axis] ? cell + last * stride(axis) : cell;
    }
};

}  // namespace cascade::measure
