// Sorts items by points of a mesh, in linear time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cascade {

/// Sorts items by operator<, which must first compare `point_of(item)`, a number below
/// `point_count`. Distributes the items to points and then sorts the few items of each point.
template <typename Item, typename PointOf>
void sort_by_point(std::vector<Item>& items, std::size_t point_count, const PointOf& point_of) {
    std::vector<std::size_t> ends(point_count + 1, 0);
    for (const Item& item : items) ++ends[point_of(item) + 1];
    for (std::size_t p = 0; p < point_count; ++p) ends[p + 1] += ends[p];
    std::vector<Item> sorted(items.size());
    for (const Item& item : items)
        // Inserting the items moves the start of each point's items to their end.
        sorted[ends[point_of(item)]++] = item;
    std::size_t begin = 0;
    for (std::size_t p = 0; p < point_count; ++p) {
        std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
                  sorted.begin() + static_cast<std::ptrdiff_t>(ends[p]));
        begin = ends[p];
    }
    items.swap(sorted);
}

}  // namespace cascade
