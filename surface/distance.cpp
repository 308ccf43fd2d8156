// Distances spread from point to point over unfolded triangles, in ascending order.
#include "surface/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace cascade {

namespace {

using Reach = SurfaceDistance::Reach;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Reach unreached = {infinity, SurfaceDistance::no_source};

/// A point is visited again only if the relative gain of the new path exceeds this.
constexpr double least_shortening = 1e-12;

/// Limit of visits per point, which only slivers could exceed, and with little gain.
constexpr std::size_t most_visits = 60;

bool is_shorter(const Reach& a, const Reach& b) {
    return std::tie(a.distance, a.source) < std::tie(b.distance, b.source);
}

/// The longest edge for which refinement gives triangles of about the requested area.
double edge_for(double area, std::size_t triangles) {
    // √(4/√3) is the edge of the equilateral triangle of area 1. 1.4 allows for halved edges.
    return 1.5197 * 1.4 *
           std::sqrt(area / static_cast<double>(std::max<std::size_t>(triangles, 1)));
}

/// The shortest path to a point p through the edge from a to b or its ends, given the paths to a
/// and b. All points are in one plane; paths reach the edge from the other side than p.
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

/// The triangles around each point.
class Fans {
public:
    explicit Fans(const SurfaceMesh& mesh) : ends_(mesh.points.size() + 1) {
        for (const auto& corners : mesh.triangles) {
            for (const std::uint32_t point : corners) ++ends_[point + 1];
        }
        for (std::size_t k = 1; k < ends_.size(); ++k) ends_[k] += ends_[k - 1];
        triangles_.resize(ends_.back());
        std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t point : mesh.triangles[t]) triangles_[next[point]++] = t;
        }
    }
    std::span<const std::uint32_t> around(std::uint32_t point) const {
        return {triangles_.data() + ends_[point], ends_[point + 1] - ends_[point]};
    }

private:
    std::vector<std::uint32_t> ends_;  ///< One more than points: each ends where the next begins.
    std::vector<std::uint32_t> triangles_;
};

struct Visit {
    double distance = 0;
    std::uint32_t point = 0;
    friend bool operator<(const Visit& a, const Visit& b) {
        return std::tie(b.distance, b.point) < std::tie(a.distance, a.point);
    }
};

}  // namespace

SurfaceDistance::SurfaceDistance(const SurfaceMesh& mesh, std::span<const SurfacePlace> sources,
                                 const std::atomic<bool>& cancel, const DistanceOptions& options)
    : refinement_(mesh, edge_for(mesh.total_area(), options.triangles), 2 * options.triangles,
                  cancel) {
    for (std::uint32_t k = 0; k < sources.size(); ++k) {
        const std::uint32_t triangle = refinement_.refined(sources[k]).triangle;
        sources_.push_back({triangle, k, position_of(mesh, sources[k])});
    }
    std::sort(sources_.begin(), sources_.end(), [](const LocalSource& a, const LocalSource& b) {
        return std::tie(a.triangle, a.number) < std::tie(b.triangle, b.number);
    });
    reached_.assign(refinement_.mesh().points.size(), unreached);
    spread(cancel);
}

void SurfaceDistance::spread(const std::atomic<bool>& cancel) {
    const SurfaceMesh& mesh = refinement_.mesh();
    const Fans fans(mesh);
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
        if (visit.distance > reached_[visit.point].distance) continue;
        for (const std::uint32_t t : fans.around(visit.point)) {
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
    const SurfacePlace fine = refinement_.refined(place);
    const SurfaceMesh& mesh = refinement_.mesh();
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
