// Joins the tables of links.
#include "device/wgsl_links.h"

namespace cascade {

WgslLinks::WgslLinks(const LinkTable<float>& table, const PlaneLayout& layout) {
    constexpr std::size_t cells = LinkTable<float>::slice_cells;
    const std::size_t slices = (static_cast<std::size_t>(layout.width) + cells - 1) / cells *
                               static_cast<std::size_t>(layout.row_count());
    const std::size_t entries = table.starts[slices];
    add(table.starts, slices + 1);
    add(table.bases, entries);
    add(table.offsets, entries * cells);
    add(table.filled, entries);
    add(table.weights, entries * cells);
    for (const float* of_axis : table.gradients) add(of_axis, entries * cells);
    places.erase(places.begin());
}

template <typename T>
void WgslLinks::add(const T* values, std::size_t count) {
    places.push_back(static_cast<std::uint32_t>(words.size()));
    if (values == nullptr) return;
    const auto added = packed_words(values, count);
    words.insert(words.end(), added.begin(), added.end());
}

}  // namespace cascade
