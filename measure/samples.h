// A field to measure: plain numbers with the shape of their grid.
#pragma once

#include "core/grid.h"
#include "core/plane.h"

#include <array>
#include <cstddef>
#include <vector>

namespace cascade::measure {

/// One value per cell, in the order of columns, rows, slices. Cells with non-finite values are
/// outside the domain and ignored.
struct Samples {
    std::array<std::size_t, 3> cells{1, 1, 1};  ///< Along x, y (downwards), z.
    std::array<bool, 3> periodic{true, true,
                                 true};  ///< Otherwise the field is mirrored at the sides.
    double spacing = 1;                  ///< Width of a cell in the unit of length.
    std::vector<double> values;

    std::size_t count() const { return values.size(); }
    /// Distance in `values` between neighbours along an axis.
    std::size_t stride(std::size_t axis) const {
        return axis == 0 ? 1 : axis == 1 ? cells[0] : cells[0] * cells[1];
    }
    /// Index of a cell along an axis.
    std::size_t position(std::size_t cell, std::size_t axis) const {
        return cell / stride(axis) % cells[axis];
    }
    /// The next or previous neighbour along an axis; the cell itself at a mirrored side.
    std::size_t neighbour(std::size_t cell, std::size_t axis, bool forwards) const {
        const std::size_t at = position(cell, axis), last = cells[axis] - 1;
        if (forwards) {
            if (at < last) return cell + stride(axis);
            return periodic[axis] ? cell - last * stride(axis) : cell;
        }
        if (at > 0) return cell - stride(axis);
        return periodic[axis] ? cell + last * stride(axis) : cell;
    }
    /// The cell at a distance along an axis, in cells, forwards or backwards: across periodic
    /// sides, or mirrored at other sides.
    std::size_t mirrored(std::size_t cell, std::size_t axis, std::ptrdiff_t distance) const {
        const std::size_t at = position(cell, axis);
        const auto count = static_cast<std::ptrdiff_t>(cells[axis]);
        const std::ptrdiff_t period = periodic[axis] ? count : 2 * count;
        std::ptrdiff_t there = (static_cast<std::ptrdiff_t>(at) + distance) % period;
        if (there < 0) there += period;
        if (there >= count) there = period - 1 - there;
        return cell - at * stride(axis) + static_cast<std::size_t>(there) * stride(axis);
    }
};

/// The samples of a field on this grid.
Samples to_samples(const Field& field, const Grid& grid);

}  // namespace cascade::measure
