// The arrays of a table of links, in the order in which kernels of devices receive them.
#pragma once

#include "core/grid.h"
#include "core/links.h"

#include <cstddef>

namespace cascade {

/// Calls `add(values, count)` for each array of a table. `values` is null for an array that the
/// table lacks.
template <typename Number, typename Add>
void for_link_arrays(const LinkTable<Number>& table, const PlaneLayout& layout, const Add& add) {
    constexpr std::size_t cells = LinkTable<Number>::slice_cells;
    const std::size_t slices = (static_cast<std::size_t>(layout.width) + cells - 1) / cells *
                               static_cast<std::size_t>(layout.row_count());
    const std::size_t entries = table.starts[slices];
    add(table.starts, slices + 1);
    add(table.bases, entries);
    add(table.offsets, entries * cells);
    add(table.filled, entries);
    add(table.weights, entries * cells);
    for (const Number* of_axis : table.gradients) add(of_axis, entries * cells);
}

}  // namespace cascade
