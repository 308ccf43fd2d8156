// Compares each edge of the outline with all edges whose ranges along x overlap its own range.
#include "atlas/chart_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace cascade {

namespace {

/// An edge of the outline, with the chart on its left.
struct Side {
    std::uint32_t from = 0, to = 0;  ///< Indices of positions.
    double low = 0, high = 0;        ///< Its range along x.
};

std::vector<Side> outline_of(const Seams& seams, const Chart& chart) {
    std::vector<Side> sides;
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!seams[chart.triangles[n]][k]) continue;
            const std::uint32_t a = chart.corners[n][k], b = chart.corners[n][corner_after(k)];
            const auto [low, high] = std::minmax(chart.places[a].x, chart.places[b].x);
            sides.push_back({a, b, low, high});
        }
    }
    return sides;
}

bool meet(Vector2d a, Vector2d b, Vector2d c, Vector2d d) {
    if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) {
        return false;
    }
    const double of_c = cross(b - a, c - a), of_d = cross(b - a, d - a);
    const double of_a = cross(d - c, a - c), of_b = cross(d - c, b - c);
    return !((of_c > 0 && of_d > 0) || (of_c < 0 && of_d < 0) || (of_a > 0 && of_b > 0) ||
             (of_a < 0 && of_b < 0));
}

bool has_crossing(const Chart& chart, std::vector<Side> sides) {
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.from) < std::tie(b.low, b.from);
    });
    const std::vector<Vector2d>& at = chart.places;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side& one = sides[i];
        for (std::size_t j = i + 1; j < sides.size() && sides[j].low <= one.high; ++j) {
            const Side& other = sides[j];
            if (one.from == other.from || one.from == other.to || one.to == other.from ||
                one.to == other.to) {
                continue;
            }
            if (meet(at[one.from], at[one.to], at[other.from], at[other.to])) return true;
        }
    }
    return false;
}

/// The number of loops of the outline that are counterclockwise.
std::size_t count_outer(const Chart& chart, const std::vector<Side>& sides) {
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> next(chart.places.size(), none);
    // Each position has one fan, so one edge begins there.
    for (const Side& side : sides) next[side.from] = side.to;
    std::size_t outer = 0;
    for (const Side& side : sides) {
        double area = 0;
        for (std::uint32_t p = side.from; next[p] != none;) {
            const std::uint32_t q = next[p];
            const Vector2d origin = chart.places[side.from];
            area += cross(chart.places[p] - origin, chart.places[q] - origin);
            next[p] = none;
            p = q;
        }
        outer += area > 0;
    }
    return outer;
}

}  // namespace

bool is_injective(const Seams& seams, const Chart& chart) {
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
        // The negation also rejects areas that are not finite.
        if (!(double_area(chart.flat(n)) > 0)) return false;
    }
    std::vector<Side> sides = outline_of(seams, chart);
    return count_outer(chart, sides) == 1 && !has_crossing(chart, std::move(sides));
}

ChartStretch stretch_of(const SurfaceMesh& mesh, const Chart& chart) {
    ChartStretch sum;
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
        const std::uint32_t triangle = chart.triangles[n];
        const double area = mesh.area(triangle);
        const double own = distortion(stretches(shape_of(mesh, triangle), chart.flat(n)));
        sum.area += area;
        sum.mean += area * own;
        sum.worst = std::max(sum.worst, own);
        if (!(own <= ChartStretch::bad_distortion)) sum.bad += area;
    }
    const double all = std::max(sum.area, std::numeric_limits<double>::min());
    sum.mean /= all;
    sum.bad /= all;
    return sum;
}

}  // namespace cascade
