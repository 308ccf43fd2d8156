// Sorts the walls by their cells and adds up those of the same pair.
#include "surface/wall_list.h"

#include <algorithm>
#include <tuple>

namespace cascade {

void WallList::add(std::uint32_t a, std::uint32_t b, double length, double distance) {
    if (a == b || !(length > 0)) return;
    walls_.push_back({a, b, length, length / distance});
    walls_.push_back({b, a, length, length / distance});
}

void WallList::put_into(SurfaceCells& cells, std::size_t count) {
    std::stable_sort(walls_.begin(), walls_.end(), [](const Wall& a, const Wall& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    cells.ends.assign(count, 0);
    cells.walls.clear();
    for (auto begin = walls_.begin(), end = begin; begin != walls_.end(); begin = end) {
        double length = 0, weight = 0;
        for (; end != walls_.end() && end->from == begin->from && end->to == begin->to; ++end) {
            length += end->length;
            weight += end->weight;
        }
        cells.walls.push_back({begin->to, length, length / weight});
        cells.ends[begin->from] = cells.walls.size();
    }
    for (std::size_t k = 1; k < count; ++k)
        cells.ends[k] = std::max(cells.ends[k], cells.ends[k - 1]);
    walls_.clear();
}

}  // namespace cascade
