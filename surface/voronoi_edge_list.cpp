// Sorts the Voronoi edges by cells and merges edges of the same pair.
#include "surface/voronoi_edge_list.h"

#include <algorithm>
#include <tuple>

namespace cascade {

void VoronoiEdgeList::add(std::uint32_t a, std::uint32_t b, double length, double distance) {
    if (a == b || !(length > 0)) return;
    edges_.push_back({a, b, length, length / distance});
    edges_.push_back({b, a, length, length / distance});
}

void VoronoiEdgeList::put_into(SurfaceCells& cells, std::size_t count) {
    std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    cells.ends.assign(count, 0);
    cells.edges.clear();
    for (auto begin = edges_.begin(), end = begin; begin != edges_.end(); begin = end) {
        double length = 0, weight = 0;
        for (; end != edges_.end() && end->from == begin->from && end->to == begin->to; ++end) {
            length += end->length;
            weight += end->weight;
        }
        cells.edges.push_back({begin->to, length, length / weight});
        cells.ends[begin->from] = cells.edges.size();
    }
    for (std::size_t k = 1; k < count; ++k)
        cells.ends[k] = std::max(cells.ends[k], cells.ends[k - 1]);
    edges_.clear();
}

}  // namespace cascade
