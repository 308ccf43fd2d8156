// Floods the surface from its peaks downwards. Where two floods meet, the lower peak ends.
#include "surface/tips.h"

#include "mesh/disjoint_sets.h"
#include "mesh/flat.h"
#include "surface/distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace cascade {
namespace {

/// A peak is not a tip if it is lower than `least_of_highest` times the highest peak, or lower than
/// `least_of_mean` times the mean distance. Such peaks are bumps of the surface, or errors of means
/// over a few sources.
constexpr double least_of_highest = 0.05, least_of_mean = 0.03;
constexpr std::size_t most_sources = 30;
/// With this number of triangles, the positions of tips are exact enough. More triangles would only
/// take longer.
constexpr std::size_t fine_enough = 10'000;

/// A corner of a triangle.
SurfacePlace corner_at(const SurfaceMesh& mesh, std::uint32_t triangle, std::uint32_t point) {
    SurfacePlace corner{triangle, {0, 0, 0}};
    for (std::size_t k = 0; k < 3; ++k) corner.weights[k] = mesh.triangles[triangle][k] == point;
    return corner;
}

/// A triangle of the connected component with the largest area.
std::uint32_t main_triangle(const SurfaceMesh& mesh) {
    const std::vector<std::uint32_t> components = connected_components(mesh);
    std::vector<double> areas(components.size());
    for (std::size_t k = 0; k < components.size(); ++k) areas[components[k]] += mesh.area(k);
    const auto largest = std::ranges::max_element(areas) - areas.begin();
    const auto found = std::ranges::find(components, static_cast<std::uint32_t>(largest));
    return static_cast<std::uint32_t>(found - components.begin());
}

/// For each point of the largest component, its mean distance from all of that component. Infinite
/// for points of other components.
std::vector<double> mean_distances(const SurfaceMesh& mesh, const std::atomic<bool>& cancel) {
    const auto prepared = std::make_shared<const DistanceMesh>(mesh, cancel, DistanceOptions{0});
    std::vector<std::vector<double>> from;
    std::vector<double> nearest(mesh.points.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> source_of(mesh.points.size());
    std::uint32_t next = mesh.triangles[main_triangle(mesh)][0];
    for (std::size_t k = 0; k < most_sources && !cancel; ++k) {
        const std::uint32_t triangle = prepared->triangles_around(next)[0];
        const SurfacePlace source = corner_at(mesh, triangle, next);
        const SurfaceDistance distance(prepared, {&source, 1}, cancel);
        std::vector<double>& values = from.emplace_back();
        double farthest = 0;
        for (std::uint32_t point = 0; point < mesh.points.size(); ++point) {
            values.push_back(distance.at_point(point).distance);
            if (values.back() < nearest[point]) {
                nearest[point] = values.back();
                source_of[point] = k;
            }
            if (std::isfinite(nearest[point]) && nearest[point] > farthest) {
                farthest = nearest[point];
                next = point;
            }
        }
    }
    // The weight of each source is the area that is nearer to it than to any other source.
    std::vector<double> areas(from.size());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        for (const std::uint32_t point : mesh.triangles[k]) {
            if (std::isfinite(nearest[point])) areas[source_of[point]] += mesh.area(k) / 3;
        }
    }
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<double> means(mesh.points.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
        for (std::size_t point = 0; point < means.size(); ++point) {
            means[point] += areas[k] / area * from[k][point];
        }
    }
    return means;
}

struct Peak {
    double height = 0;
    std::uint32_t point = 0;
};

/// The peaks of a function on the points of a mesh. The height of a peak is measured from the pass
/// to a higher peak. The height of the highest peak is measured from the lowest point. `falling`
/// has all points to consider, by falling value.
std::vector<Peak> peaks_of(const DistanceMesh& mesh, const std::vector<double>& values,
                           const std::vector<std::uint32_t>& falling) {
    std::vector<bool> is_under(values.size());
    DisjointSets floods(values.size());  // Each flood is represented by its highest point.
    std::vector<Peak> peaks;
    for (const std::uint32_t point : falling) {
        is_under[point] = true;
        for (const std::uint32_t triangle : mesh.triangles_around(point)) {
            for (const std::uint32_t other : mesh.mesh().triangles[triangle]) {
                if (!is_under[other]) continue;
                std::uint32_t lower = floods.find(point), higher = floods.find(other);
                if (lower == higher) continue;
                if (values[lower] > values[higher]) std::swap(lower, higher);
                if (lower != point) peaks.push_back({values[lower] - values[point], lower});
                floods.put_under(lower, higher);
            }
        }
    }
    peaks.push_back({values[falling.front()] - values[falling.back()], falling.front()});
    return peaks;
}

}  // namespace

std::vector<Vector3d> tips_of(const SurfaceMesh& mesh, const std::atomic<bool>& cancel) {
    const DistanceMesh fine(mesh, cancel, {fine_enough});
    if (cancel) return {};
    const std::vector<Vector3d>& points = fine.mesh().points;
    const std::vector<double> values = mean_distances(fine.mesh(), cancel);
    if (cancel) return {};
    std::vector<std::uint32_t> falling;
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        if (std::isfinite(values[point])) falling.push_back(point);
    }
    // Equal values are ordered by point, so that the result does not depend on the sorting
    // algorithm.
    std::ranges::sort(falling, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(-values[a], a) < std::pair(-values[b], b);
    });
    double mean = 0;
    for (const std::uint32_t point : falling) {
        mean += values[point] / static_cast<double>(falling.size());
    }
    std::vector<Peak> peaks = peaks_of(fine, values, falling);
    std::ranges::sort(peaks, [](const Peak& a, const Peak& b) {
        return std::pair(-a.height, a.point) < std::pair(-b.height, b.point);
    });
    std::vector<Vector3d> tips;
    const double least = std::max(least_of_highest * peaks.front().height, least_of_mean * mean);
    for (const Peak& peak : peaks) {
        if (peak.height < least || tips.size() == most_tips) break;
        tips.push_back(points[peak.point]);
    }
    return tips;
}

}  // namespace cascade
