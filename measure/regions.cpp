// Fills each region with the help of a stack. Cells are neighbours if they share a side, but not if
// they share only a corner.
#include "measure/regions.h"

#include <cmath>
#include <vector>

namespace cascade::measure {

namespace {

enum class Mark : char { outside, above, below, done };

std::vector<Mark> marks_of(const Samples& samples, double level) {
    std::vector<Mark> marks;
    marks.reserve(samples.count());
    for (const double value : samples.values) {
        marks.push_back(!std::isfinite(value) ? Mark::outside
                        : value > level       ? Mark::above
                                              : Mark::below);
    }
    return marks;
}

/// Marks all cells of the region that contains the cell `start`.
void flood(const Samples& samples, std::size_t start, std::vector<Mark>& marks,
           std::vector<std::size_t>& waiting) {
    const Mark wanted = marks[start];
    marks[start] = Mark::done;
    waiting.assign(1, start);
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool forwards : {false, true}) {
                const std::size_t next = samples.neighbour(cell, axis, forwards);
                if (marks[next] != wanted) continue;
                marks[next] = Mark::done;
                waiting.push_back(next);
            }
        }
    }
}

}  // namespace

Regions find_regions(const Samples& samples, double level) {
    std::vector<Mark> marks = marks_of(samples, level);
    std::int64_t above = 0, inside = 0;
    for (const Mark mark : marks) {
        above += mark == Mark::above ? 1 : 0;
        inside += mark != Mark::outside ? 1 : 0;
    }
    Regions regions;
    regions.area = inside > 0 ? static_cast<double>(above) / static_cast<double>(inside) : 0;
    std::vector<std::size_t> waiting;
    for (std::size_t cell = 0; cell < marks.size(); ++cell) {
        if (marks[cell] == Mark::outside || marks[cell] == Mark::done) continue;
        ++(marks[cell] == Mark::above ? regions.above : regions.below);
        flood(samples, cell, marks, waiting);
    }
    return regions;
}

}  // namespace cascade::measure
