// Tries each edge of the convex hull, because one side of the smallest rectangle contains such an
// edge.
#include "atlas/chart_box.h"

#include <utility>
#include <vector>

namespace cascade {

namespace {

/// The convex hull, counterclockwise, by Andrew's monotone chain.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
    std::sort(points.begin(), points.end(),
              [](Vector2d a, Vector2d b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
    std::vector<Vector2d> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const Vector2d p : points) {
            while (hull.size() >= begin + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

}  // namespace

TurnedBox smallest_box(const Chart& chart) {
    const std::vector<Vector2d> hull = convex_hull(chart.places);
    TurnedBox best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const Vector2d along = unit_of(hull[(k + 1) % hull.size()] - hull[k]);
        if (!(length(along) > 0)) continue;
        FlatBox box;
        for (const Vector2d p : hull) box.add({dot(along, p), cross(along, p)});
        const Vector2d size = box.size();
        if (!(size.x * size.y < least * (1 - 1e-9))) continue;
        least = size.x * size.y;
        best = {{along.x, -along.y}, size};
    }
    return best;
}

}  // namespace cascade
