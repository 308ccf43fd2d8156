// Sorting in linear time what belongs to points of a mesh.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cascade {

/// Sorts by operator<, the first key of which is the number that `point_of` says, below
/// `point_count`: items are dealt out to points, and then those of each point sorted, which are
/// few.
template <typename Item, typename PointOf>
void sort_by_point(std::vector<Item>& items, std::size_t point_count, const PointOf& point_of) {
    std::vector<std::size_t> ends(point_count + 1, 0);
    for (const Item& item : items) ++ends[point_of(item) + 1];
    for (std::size_t p = 0; p < point_count; ++p) ends[p + 1] += ends[p];
    std::vector<Item> sorted(items.size());
    for (const Item& item : items) sorted[ends[point_of(item)]++] = item;  // Now they are the ends.
    std::size_t begin = 0;
    for (std::size_t p = 0; p < point_count; ++p) {
        std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
                  sorted.begin() + static_cast<std::ptrdiff_t>(ends[p]));
        begin = ends[p];
    }
    items.swap(sorted);
}

}  // namespace cascade
