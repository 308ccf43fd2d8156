// Dijkstra's algorithm propagates each key's direction to the nearest planes. Smoothing is
// diffusion of the directions (surface/graph_diffusion).
#include "surface/key_directions.h"

#include "surface/cell_finder.h"
#include "surface/coded_directions.h"
#include "surface/graph_diffusion.h"
#include "surface/nearest_place.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace cascade {

namespace {

/// A vector scaled to length 1 without overflow; 0 if the vector is not finite.
Vector3d safe_unit(Vector3d v) {
    const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(size > 0) || !is_finite(v)) return {};
    return unit(Vector3d{v.x / size, v.y / size, v.z / size});
}

/// Propagates directions from seeds over the planes by Dijkstra's algorithm.
class Flood {
public:
    Flood(const TangentPlanes& planes, const CodedDirections& coded)
        : planes_(planes),
          coded_(coded),
          codes_(planes.size()),
          distances_(planes.size(), std::numeric_limits<double>::infinity()) {}

    bool has_reached(std::size_t node) const { return std::isfinite(distances_[node]); }
    const std::vector<Vector2d>& codes() const { return codes_; }

    void seed(std::uint32_t node, Vector2d code) {
        codes_[node] = code;
        distances_[node] = 0;
        waiting_.push({0, node});
    }

    void spread(const std::atomic<bool>& cancel) {
        for (std::size_t done = 0; !waiting_.empty(); ++done) {
            if (done % 1024 == 0 && cancel) return;
            const auto [distance, node] = waiting_.top();
            waiting_.pop();
            if (distance > distances_[node]) continue;
            for (const TangentLink& link : planes_.links_of(node)) {
                const double reached = distance + link.distance;
                if (!(reached < distances_[link.neighbour])) continue;
                distances_[link.neighbour] = reached;
                // The rotation from this plane to the neighbour's plane, which is the inverse of
                // the link's rotation.
                const Vector2d turn = coded_.turn(link);
                codes_[link.neighbour] = product(codes_[node], {turn.x, -turn.y});
                waiting_.push({reached, link.neighbour});
            }
        }
    }

private:
    using Entry = std::pair<double, std::uint32_t>;

    const TangentPlanes& planes_;
    const CodedDirections& coded_;
    std::vector<Vector2d> codes_;
    std::vector<double> distances_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;
};

/// The code of a key's direction in a plane; 0 if the direction is perpendicular to the plane.
Vector2d code_of(const CodedDirections& coded, std::uint32_t plane, const KeyDirection& key) {
    const Vector2d code = coded.of(plane, safe_unit(key.direction));
    return length(code) > cancelled_part ? unit_of(code) : Vector2d{};
}

}  // namespace

std::vector<Vector3d> key_directions(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                     std::span<const KeyDirection> keys, DirectionKind kind,
                                     const std::atomic<bool>& cancel) {
    const CodedDirections coded(planes, kind);
    const NearestPlace nearest(mesh);
    CellFinder finder(mesh, planes.places);
    Flood flood(planes, coded);
    std::vector<const KeyDirection*> placed;
    for (const KeyDirection& key : keys) {
        const auto place = nearest.find(key.position);
        const std::uint32_t plane = place ? finder.at(*place) : CellFinder::nothing;
        if (plane == CellFinder::nothing || flood.has_reached(plane)) continue;
        const Vector2d code = code_of(coded, plane, key);
        if (!(length(code) > 0)) continue;
        flood.seed(plane, code);
        placed.push_back(&key);
    }
    if (placed.empty()) return directions(planes, std::vector<Vector3d>(planes.size()), kind);
    flood.spread(cancel);
    for (std::uint32_t plane = 0; plane < planes.size() && !cancel; ++plane) {
        if (flood.has_reached(plane)) continue;
        const Vector3d position = position_of(mesh, planes.places[plane]);
        const KeyDirection* key = *std::min_element(
            placed.begin(), placed.end(), [&](const KeyDirection* a, const KeyDirection* b) {
                return length(a->position - position) < length(b->position - position);
            });
        const Vector2d code = code_of(coded, plane, *key);
        flood.seed(plane, length(code) > 0 ? code : Vector2d{1, 0});
        flood.spread(cancel);
    }
    return coded.in_space(flood.codes());
}

std::vector<Vector3d> smoothed_directions(const TangentPlanes& planes,
                                          std::span<const Vector3d> field, DirectionKind kind,
                                          double length, Team& team,
                                          const std::atomic<bool>& cancel) {
    const CodedDirections coded(planes, kind);
    DiffusionGraph<Vector2d> graph;
    graph.masses = planes.areas;
    graph.ends = planes.ends;
    graph.links.reserve(planes.links.size());
    for (const TangentLink& link : planes.links) {
        graph.links.push_back({link.neighbour, link.weight, coded.turn(link) * link.weight});
    }
    std::vector<Vector2d> codes;
    codes.reserve(field.size());
    for (std::size_t k = 0; k < field.size(); ++k) codes.push_back(coded.of(k, field[k]));
    std::vector<Vector2d> smooth = diffused(graph, codes, length * length / 2, team, cancel);
    for (std::size_t k = 0; k < smooth.size(); ++k) {
        if (!(std::hypot(smooth[k].x, smooth[k].y) > cancelled_part)) smooth[k] = codes[k];
    }
    return coded.in_space(smooth);
}

}  // namespace cascade
