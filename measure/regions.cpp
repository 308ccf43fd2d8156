// Flood fill with a stack; cells are neighbours across their sides, not across their corners.
#include "measure/regions.h"

#include <cmath>
#include <vector>

namespace cascade::measure {

namespace {

enum class Side : char { outside, above, below, done };

std::vector<Side> sides_of(const Samples& samples, double level) {
    std::vector<Side> sides;
    sides.reserve(samples.count());
    for (const double value : samples.values) {
        sides.push_back(!std::isfinite(value) ? Side::outside
                        : value > level       ? Side::above
                                              : Side::below);
    }
    return sides;
}

/// Marks the region of a cell as done.
void flood(const Samples& samples, std::size_t start, std::vector<Side>& sides,
           std::vector<std::size_t>& waiting) {
    const Side wanted = sides[start];
    sides[start] = Side::done;
    waiting.assign(1, start);
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool forwards : {false, true}) {
                const std::size_t next = samples.neighbour(cell, axis, forwards);
                if (sides[next] != wanted) continue;
                sides[next] = Side::done;
                waiting.push_back(next);
            }
        }
    }
}

}  // namespace

Regions find_regions(const Samples& samples, double level) {
    std::vector<Side> sides = sides_of(samples, level);
    std::int64_t above = 0, inside = 0;
    for (const Side side : sides) {
        above += side == Side::above ? 1 : 0;
        inside += side != Side::outside ? 1 : 0;
    }
    Regions regions;
    regions.area = inside > 0 ? static_cast<double>(above) / static_cast<double>(inside) : 0;
    std::vector<std::size_t> waiting;
    for (std::size_t cell = 0; cell < sides.size(); ++cell) {
        if (sides[cell] == Side::outside || sides[cell] == Side::done) continue;
        ++(sides[cell] == Side::above ? regions.above : regions.below);
        flood(samples, cell, sides, waiting);
    }
    return regions;
}

}  // namespace cascade::measure
