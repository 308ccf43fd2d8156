// Numbers cells, and finds what each halo cell depends on.
#include "continuation/padded_grid.h"

#include <algorithm>
#include <numeric>

namespace cascade::continuation {

PaddedGrid::PaddedGrid(const Grid& grid)
    : axes_(grid.stencil()), spacing_(grid.spacing), lengths_{grid.width, grid.height, grid.depth} {
    std::int64_t size = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        padded_[axis] = lengths_[axis] + (axes_.has(static_cast<int>(axis)) ? 2 : 0);
        strides_[axis] = size;
        size *= padded_[axis];
    }
    size_ = static_cast<Index>(size);
    const auto is_inside = [&](Index cell) {
        for (int axis = 0; axis < 3; ++axis) {
            if (position(cell, axis) < 0 || position(cell, axis) >= length(axis)) return false;
        }
        return true;
    };
    for (Index cell = 0; cell < size_; ++cell) {
        if (is_inside(cell)) cells_.push_back(cell);
    }
    find_halo();
}

Index PaddedGrid::shift(Offset offset) const {
    const std::array<int, 3> by{offset.dx, offset.dy, offset.dz};
    std::int64_t sum = 0;
    for (const int axis : axes_.present) {
        sum += by[static_cast<std::size_t>(axis)] * strides_[static_cast<std::size_t>(axis)];
    }
    return static_cast<Index>(sum);
}

std::int64_t PaddedGrid::position(Index padded, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    return padded / strides_[k] % padded_[k] - (axes_.has(axis) ? 1 : 0);
}

/// As fill_halo() does: columns first, then rows with their halo columns, then slices.
void PaddedGrid::find_halo() {
    for (const int axis : axes_.present) {
        for (Index cell = 0; cell < size_; ++cell) {
            const std::int64_t at = position(cell, axis);
            if (at >= 0 && at < length(axis)) continue;
            // Cells beyond a side of a later axis are filled with that axis.
            bool is_later = false;
            Index beside = cell;
            for (int other = 0; other < 3; ++other) {
                const std::int64_t there = position(cell, other);
                const std::int64_t clamped = std::clamp<std::int64_t>(there, 0, length(other) - 1);
                is_later = is_later || (other > axis && clamped != there);
                beside += static_cast<Index>((clamped - there) *
                                             strides_[static_cast<std::size_t>(other)]);
            }
            if (is_later) continue;
            const Index step = shift(Offset::along(axis, at < 0 ? 1 : -1));
            const auto around = static_cast<Index>(length(axis));
            halo_.push_back(
                {cell, cell + step, cell + around * step, 2 * axis + (at < 0 ? 0 : 1), beside});
        }
    }
}

std::vector<Index> PaddedGrid::sources(const Boundaries& boundary) const {
    std::vector<Index> sources(static_cast<std::size_t>(size_));
    std::iota(sources.begin(), sources.end(), Index{0});
    const std::array along{boundary.x, boundary.y, boundary.z};
    for (const HaloCell& halo : halo_) {
        const bool is_periodic =
            along[static_cast<std::size_t>(halo.side / 2)] == Boundary::periodic;
        sources[static_cast<std::size_t>(halo.cell)] =
            sources[static_cast<std::size_t>(is_periodic ? halo.opposite : halo.inner)];
    }
    return sources;
}

}  // namespace cascade::continuation
