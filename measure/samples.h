// The values of a field as plain numbers, with the shape of their grid.
#pragma once

#include "core/grid.h"
#include "core/plane.h"

#include <array>
#include <cstddef>
#include <vector>

namespace cascade::measure {

/// One value for each cell, ordered so that the column varies fastest, then the row, then the
/// slice. A cell whose value is not finite counts as outside the domain.
struct Samples {
    std::array<std::size_t, 3> cells{1, 1, 1};  ///< Along x, y (downwards) and z.
    /// Whether the field is periodic along x, y and z. At sides that are not periodic it is
    /// mirrored.
    std::array<bool, 3> periodic{true, true, true};
    /// The lengths of a cell along x, y and z in the unit of length.
    std::array<double, 3> spacing{1, 1, 1};
    std::vector<double> values;

    std::size_t count() const { return values.size(); }
    /// The distance in `values` between neighbours along an axis.
    std::size_t stride(std::size_t axis) const {
        return axis == 0 ? 1 : axis == 1 ? cells[0] : cells[0] * cells[1];
    }
    /// The column, row or slice of a cell.
    std::size_t position(std::size_t cell, std::size_t axis) const {
        return cell / stride(axis) % cells[axis];
    }
    /// The next or previous neighbour of a cell along an axis. At a mirrored side, this is the cell
    /// itself.
    std::size_t neighbour(std::size_t cell, std::size_t axis, bool forwards) const {
        const std::size_t at = position(cell, axis), last = cells[axis] - 1;
        if (forwards) {
            if (at < last) return cell + stride(axis);
            return periodic[axis] ? cell - last * stride(axis) : cell;
        }
        if (at > 0) return cell - stride(axis);
        return periodic[axis] ? cell + last * stride(axis) : cell;
    }
    /// The cell at a distance from `cell` along an axis. The distance is in cells and may be
    /// negative. If it crosses a side, the field continues periodically or mirrored there.
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

/// Copies the values of a field on this grid.
Samples to_samples(const Field& field, const Grid& grid);

}  // namespace cascade::measure
