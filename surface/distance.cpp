// Propagates distances from point to point over unfolded triangles, in ascending order.
#include "surface/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace cascade {

namespace {

using Reach = SurfaceDistance::Reach;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Reach unreached = {infinity, SurfaceDistance::no_source};

/// A point is visited again only if the new path is shorter by more than this fraction.
constexpr double least_shortening = 1e-12;

/// The limit of visits per point. Only slivers could exceed it, and distances would hardly change.
constexpr std::size_t most_visits = 60;

bool is_shorter(const Reach& a, const Reach& b) {
    return std::tie(a.distance, a.source) < std::tie(b.distance, b.source);
}

/// The longest edge to allow when a surface of this area is refined to about this many triangles.
double edge_for(double area, std::size_t triangles) {
    // The edge of the equilateral triangle of area 1 is √(4/√3) = 1.5197. The factor 1.4 allows for
    // edges that are halved once more than necessary.
    return 1.5197 * 1.4 *
           std::sqrt(area / static_cast<double>(std::max<std::size_t>(triangles, 1)));
}

/// The shortest path to a point p through the edge from a to b or its ends, given the paths to a
/// and b. All points are in one plane. p and the starts of the paths are on different sides of the
/// edge.
Reach over_edge(Vector2d a, const Reach& to_a, Vector2d b, const Reach& to_b, Vector2d p) {
    const Reach along_a = {to_a.distance + length(p - a), to_a.source};
    const Reach along_b = {to_b.distance + length(p - b), to_b.source};
    const Reach best = is_shorter(along_b, along_a) ? along_b : along_a;
    if (to_a.distance == infinity || to_b.distance == infinity) return best;

    const Vector2d edge = b - a;
    const double size = length(edge);
    if (!(size > 0)) return best;
    // Coordinates of p: along the edge from a, and away from the edge.
    const double along = dot(p - a, edge) / size, height = std::abs(cross(edge, p - a)) / size;
    const double difference = (to_a.distance - to_b.distance) / size;
    const double origin = (size + difference * (to_a.distance + to_b.distance)) / 2;
    const double square = (to_a.distance - origin) * (to_a.distance + origin);
    if (square < -1e-9 * size * size) return best;
    const double depth = std::sqrt(std::max(0.0, square));
    if (!(depth + height > 0)) return best;
    const double crossing = origin + (along - origin) * (depth / (depth + height));
    if (crossing < 0 || crossing > size) return best;
    const Reach straight = {std::hypot(along - origin, depth + height),
                            is_shorter(to_b, to_a) ? to_b.source : to_a.source};
    return is_shorter(straight, best) ? straight : best;
}

struct Visit {
    double distance = 0;
    std::uint32_t point = 0;
    friend bool operator<(const Visit& a, const Visit& b) {
        return std::tie(b.distance, b.point) < std::tie(a.distance, a.point);
    }
};

}  // namespace

DistanceMesh::DistanceMesh(const SurfaceMesh& mesh, const std::atomic<bool>& cancel,
                           const DistanceOptions& options)
    : original_(mesh),
      refinement_(mesh, edge_for(mesh.total_area(), options.triangles), 2 * options.triangles,
                  cancel),
      ends_(refinement_.mesh().points.size() + 1) {
    const SurfaceMesh& fine = refinement_.mesh();
    for (std::uint32_t t = 0; t < fine.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            ++ends_[fine.triangles[t][k] + 1];
            longest_edge_ =
                std::max(longest_edge_, length(fine.corner(t, (k + 1) % 3) - fine.corner(t, k)));
        }
    }
    for (std::size_t k = 1; k < ends_.size(); ++k) ends_[k] += ends_[k - 1];
    around_.resize(ends_.back());
    std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
    for (std::uint32_t t = 0; t < fine.triangles.size(); ++t) {
        for (const std::uint32_t point : fine.triangles[t]) around_[next[point]++] = t;
    }
}

SurfaceDistance::SurfaceDistance(std::shared_ptr<const DistanceMesh> mesh,
                                 std::span<const SurfacePlace> sources,
                                 const std::atomic<bool>& cancel, double reach)
    : mesh_(std::move(mesh)) {
    for (std::uint32_t k = 0; k < sources.size(); ++k) {
        const std::uint32_t triangle = mesh_->refinement().refined(sources[k]).triangle;
        sources_.push_back({triangle, k, position_of(mesh_->original(), sources[k])});
    }
    std::sort(sources_.begin(), sources_.end(), [](const LocalSource& a, const LocalSource& b) {
        return std::tie(a.triangle, a.number) < std::tie(b.triangle, b.number);
    });
    reached_.assign(mesh_->mesh().points.size(), unreached);
    spread(reach, cancel);
}

void SurfaceDistance::spread(double reach_asked_for, const std::atomic<bool>& cancel) {
    const SurfaceMesh& mesh = mesh_->mesh();
    // The front goes on for this many edge lengths beyond `reach`. A path within the reach is
    // computed from the distances of two points. Either of them may be farther away than the end of
    // the path, and may get a shorter path when a later point is visited.
    constexpr double edges_beyond = 4;
    const double farthest = reach_asked_for + edges_beyond * mesh_->longest_edge();
    std::vector<Visit> visits;
    const auto reach = [&](std::uint32_t point, const Reach& found) {
        Reach& known = reached_[point];
        if (!(found.distance < known.distance * (1 - least_shortening))) return;
        known = found;
        visits.push_back({found.distance, point});
        std::push_heap(visits.begin(), visits.end());
    };
    for (const LocalSource& source : sources_) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            reach(mesh.triangles[source.triangle][k],
                  {length(mesh.corner(source.triangle, k) - source.position), source.number});
        }
    }
    const std::size_t most = most_visits * mesh.points.size();
    for (std::size_t done = 0; !visits.empty() && done < most; ++done) {
        if (done % 1024 == 0 && cancel) return;
        std::pop_heap(visits.begin(), visits.end());
        const Visit visit = visits.back();
        visits.pop_back();
        if (visit.distance > farthest) return;
        if (visit.distance > reached_[visit.point].distance) continue;
        for (const std::uint32_t t : mesh_->triangles_around(visit.point)) {
            const auto& corners = mesh.triangles[t];
            const FlatTriangle flat = own_frame(mesh, t);
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (corners[k] == visit.point) continue;
                const std::uint32_t a = (k + 1) % 3, b = (k + 2) % 3;
                reach(corners[k], over_edge(flat[a], reached_[corners[a]], flat[b],
                                            reached_[corners[b]], flat[k]));
            }
        }
    }
}

std::span<const SurfaceDistance::LocalSource> SurfaceDistance::sources_in(
    std::uint32_t triangle) const {
    const auto [first, last] = std::equal_range(
        sources_.begin(), sources_.end(), LocalSource{triangle, 0, {}},
        [](const LocalSource& a, const LocalSource& b) { return a.triangle < b.triangle; });
    return {first, last};
}

Reach SurfaceDistance::at(const SurfacePlace& place) const {
    const SurfacePlace fine = mesh_->refinement().refined(place);
    const SurfaceMesh& mesh = mesh_->mesh();
    const auto& corners = mesh.triangles[fine.triangle];
    const FlatTriangle flat = own_frame(mesh, fine.triangle);
    const Vector2d p = position_of(flat, fine.weights);
    Reach best = unreached;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t next = (k + 1) % 3;
        const Reach found =
            over_edge(flat[k], reached_[corners[k]], flat[next], reached_[corners[next]], p);
        if (is_shorter(found, best)) best = found;
    }
    const Vector3d position = position_of(mesh, fine);
    for (const LocalSource& source : sources_in(fine.triangle)) {
        const Reach found = {length(position - source.position), source.number};
        if (is_shorter(found, best)) best = found;
    }
    return best;
}

std::vector<double> distances_of_cells(const SurfaceDistance& distance, const SurfaceCells& cells) {
    std::vector<double> distances;
    distances.reserve(cells.places.size());
    for (const SurfacePlace& place : cells.places) distances.push_back(distance.at(place).distance);
    return distances;
}

}  // namespace cascade
