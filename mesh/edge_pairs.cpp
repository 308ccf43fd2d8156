// Sorts half-edges by their two points. At edges with more than two triangles, pairs the triangles
// that continue each other best. Then orients triangles breadth-first.
#include "mesh/edge_pairs.h"

#include "mesh/disjoint_sets.h"
#include "mesh/sort_by_point.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;

/// The largest number of triangles at an edge that are paired. At an edge with more triangles, all
/// of them get a boundary.
constexpr std::size_t most_at_edge = 16;

struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< The points in ascending order.
    TriangleEdge place;

    friend bool operator<(const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.place.triangle, a.place.edge) <
               std::tie(b.low, b.high, b.place.triangle, b.place.edge);
    }
    bool same_points(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::uint32_t from(Triangles triangles, TriangleEdge e) { return triangles[e.triangle][e.edge]; }
std::uint32_t apex(Triangles triangles, TriangleEdge e) {
    return triangles[e.triangle][(e.edge + 2) % 3];
}

/// The unit vector perpendicular to the edge that points into the triangle.
Vector3d inwards(std::span<const Vector3d> points, Triangles triangles, const HalfEdge& edge) {
    const Vector3d along = unit(points[edge.high] - points[edge.low]);
    const Vector3d side = points[apex(triangles, edge.place)] - points[edge.low];
    return unit(side - along * dot(side, along));
}

/// Two triangles at a non-manifold edge that could be connected. Matches are connected in ascending
/// order.
struct Match {
    bool is_elsewhere_apart = false;
    bool turns_against = false;
    double fold = 0;  ///< The cosine of the angle between the triangles: −1 if they are coplanar.
    std::size_t first = 0, second = 0;

    friend bool operator<(const Match& a, const Match& b) {
        const auto key = [](const Match& m) {
            return std::tie(m.is_elsewhere_apart, m.turns_against, m.fold, m.first, m.second);
        };
        return key(a) < key(b);
    }
};

class EdgePairer {
public:
    EdgePairer(std::span<const Vector3d> points, Triangles triangles)
        : points_(points), triangles_(triangles), sheets_(triangles.size()) {
        result_.across.resize(triangles.size());
    }

    EdgePairs pair() {
        std::vector<HalfEdge> edges;
        edges.reserve(3 * triangles_.size());
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
                edges.push_back({std::min(a, b), std::max(a, b), {t, k}});
            }
        }
        sort_by_point(edges, points_.size(), [](const HalfEdge& edge) { return edge.low; });
        std::vector<std::span<const HalfEdge>> non_manifold;
        for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edges[end].same_points(edges[begin])) ++end;
            if (end - begin == 2) {
                join(edges[begin].place, edges[begin + 1].place);
                sheets_.join(edges[begin].place.triangle, edges[begin + 1].place.triangle);
            } else if (end - begin > 2) {
                non_manifold.emplace_back(edges.data() + begin, end - begin);
            }
        }
        result_.non_manifold_edges = non_manifold.size();
        for (const std::span<const HalfEdge> group : non_manifold) pair_non_manifold(group);
        return std::move(result_);
    }

private:
    void join(TriangleEdge a, TriangleEdge b) {
        result_.across[a.triangle][a.edge] = b;
        result_.across[b.triangle][b.edge] = a;
    }

    Match match_of(std::span<const HalfEdge> group, std::size_t first, std::size_t second) {
        const HalfEdge &a = group[first], &b = group[second];
        return {sheets_.find(a.place.triangle) != sheets_.find(b.place.triangle),
                from(triangles_, a.place) == from(triangles_, b.place),
                dot(inwards(points_, triangles_, a), inwards(points_, triangles_, b)), first,
                second};
    }

    void pair_non_manifold(std::span<const HalfEdge> group) {
        if (group.size() > most_at_edge) return;
        std::vector<Match> matches;
        for (std::size_t a = 0; a < group.size(); ++a) {
            for (std::size_t b = a + 1; b < group.size(); ++b) {
                matches.push_back(match_of(group, a, b));
            }
        }
        std::sort(matches.begin(), matches.end());
        std::vector<bool> taken(group.size());
        for (const Match& match : matches) {
            if (taken[match.first] || taken[match.second]) continue;
            taken[match.first] = taken[match.second] = true;
            join(group[match.first].place, group[match.second].place);
        }
    }

    std::span<const Vector3d> points_;
    Triangles triangles_;
    DisjointSets sheets_;  ///< Sets of triangles connected over manifold edges.
    EdgePairs result_;
};

/// Orients the triangles of each component consistently.
class Orienter {
public:
    Orienter(std::span<const Vector3d> points, Triangles triangles,
             std::vector<std::array<TriangleEdge, 3>>& across)
        : points_(points), triangles_(triangles), across_(across), seen_(triangles.size()) {
        result_.is_turned.resize(triangles.size());
    }

    Orientation orient() {
        for (std::uint32_t start = 0; start < triangles_.size(); ++start) {
            if (!seen_[start]) orient_component(start);
        }
        return std::move(result_);
    }

private:
    /// Works breadth-first, so that a one-sided component is cut where two fronts meet.
    void orient_component(std::uint32_t start) {
        std::vector<std::uint32_t> component = {start};
        seen_[start] = true;
        for (std::size_t k = 0; k < component.size(); ++k) visit(component[k], component);
        turn_outwards(component);
    }

    void visit(std::uint32_t triangle, std::vector<std::uint32_t>& component) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleEdge here = {triangle, k};
            const TriangleEdge other = across_[triangle][k];
            if (!other.exists()) continue;
            const bool against = from(triangles_, here) == from(triangles_, other);
            const bool wanted = result_.is_turned[triangle] != against;
            if (!seen_[other.triangle]) {
                seen_[other.triangle] = true;
                result_.is_turned[other.triangle] = wanted;
                component.push_back(other.triangle);
            } else if (result_.is_turned[other.triangle] != wanted) {
                across_[triangle][k] = {};
                across_[other.triangle][other.edge] = {};
                ++result_.cut_edges;
            }
        }
    }

    void turn_outwards(const std::vector<std::uint32_t>& component) {
        const Vector3d origin = points_[triangles_[component[0]][0]];
        double volume = 0, kept = 0, turned = 0;
        bool is_closed = true;
        for (const std::uint32_t t : component) {
            const Vector3d a = points_[triangles_[t][0]] - origin;
            const Vector3d b = points_[triangles_[t][1]] - origin;
            const Vector3d c = points_[triangles_[t][2]] - origin;
            (result_.is_turned[t] ? turned : kept) += length(cross(b - a, c - a));
            volume += dot(a, cross(b, c)) * (result_.is_turned[t] ? -1 : 1);
            for (const TriangleEdge& other : across_[t]) is_closed = is_closed && other.exists();
        }
        const bool was_uniform = turned == 0;
        const bool reversed = is_closed ? volume < 0 : turned > kept;
        for (const std::uint32_t t : component) {
            if (reversed) result_.is_turned[t] = !result_.is_turned[t];
            result_.turned += result_.is_turned[t] && !was_uniform;
        }
        result_.inside_out += reversed && was_uniform;
    }

    std::span<const Vector3d> points_;
    Triangles triangles_;
    std::vector<std::array<TriangleEdge, 3>>& across_;
    std::vector<bool> seen_;
    Orientation result_;
};

}  // namespace

EdgePairs pair_edges(std::span<const Vector3d> points,
                     std::span<const std::array<std::uint32_t, 3>> triangles) {
    return EdgePairer(points, triangles).pair();
}

SurfaceMesh mesh_of(std::vector<Vector3d> points,
                    std::vector<std::array<std::uint32_t, 3>> triangles) {
    SurfaceMesh mesh;
    mesh.across = pair_edges(points, triangles).across;
    mesh.points = std::move(points);
    mesh.triangles = std::move(triangles);
    return mesh;
}

Orientation orient(std::span<const Vector3d> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   std::vector<std::array<TriangleEdge, 3>>& across) {
    return Orienter(points, triangles, across).orient();
}

}  // namespace cascade
