// Joins the tables of links.
#include "device/wgsl_links.h"

#include "device/link_arrays.h"

namespace cascade {

WgslLinks::WgslLinks(const LinkTable<float>& table, const PlaneLayout& layout) {
    for_link_arrays(table, layout,
                    [&](const auto* values, std::size_t count) { add(values, count); });
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
