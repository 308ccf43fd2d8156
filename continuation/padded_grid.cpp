// Numbers the cells, and finds the cells on which each halo cell depends.
#include "continuation/padded_grid.h"

#include <algorithm>
#include <numeric>

namespace cascade::continuation {

PaddedGrid::PaddedGrid(const DomainCells& cells)
    : axes_(cells.grid.stencil()),
      spacing_(cells.grid.spacing),
      lengths_{cells.grid.width, cells.grid.height, cells.grid.depth},
      links_(cells.links) {
    std::int64_t size = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        padded_[axis] = lengths_[axis] + (axes_.has(static_cast<int>(axis)) ? 2 : 0);
        strides_[axis] = size;
        size *= padded_[axis];
    }
    size_ = static_cast<Index>(size);
    find_halo();
    find_cells(cells);
}

void PaddedGrid::find_cells(const DomainCells& cells) {
    const auto is_in_grid = [&](Index cell) {
        for (int axis = 0; axis < 3; ++axis) {
            if (position(cell, axis) < 0 || position(cell, axis) >= length(axis)) return false;
        }
        return true;
    };
    inside_.resize(static_cast<std::size_t>(size_), true);
    std::size_t number = 0;
    for (Index cell = 0; cell < size_; ++cell) {
        if (!is_in_grid(cell)) continue;
        positions_.push_back(cell);
        const bool is_cell = cells.inside.empty() || cells.inside[number];
        inside_[static_cast<std::size_t>(cell)] = is_cell;
        if (is_cell) cells_.push_back(cell);
        has_outside_ = has_outside_ || !is_cell;
        ++number;
    }
    const std::vector<Index> sources = this->sources(cells.grid.boundary);
    for (const HaloCell& halo : halo_) {
        const auto from = static_cast<std::size_t>(sources[static_cast<std::size_t>(halo.cell)]);
        inside_[static_cast<std::size_t>(halo.cell)] = inside_[from];
    }
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

/// Lists the halo cells in the order of fill_halo(): columns first, then rows with their halo
/// columns, then slices.
void PaddedGrid::find_halo() {
    for (const int axis : axes_.present) {
        for (Index cell = 0; cell < size_; ++cell) {
            const std::int64_t at = position(cell, axis);
            if (at >= 0 && at < length(axis)) continue;
            // A halo cell that is also beyond a side of a later axis is listed with that axis.
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
