// Cuts the longest edge first, using a priority queue. Records the cuts of each triangle, so that
// positions of the old mesh can be found in the new one.
#include "surface/refinement.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

/// An edge that may be cut. The entry is outdated if the triangle no longer has this edge.
struct LongEdge {
    double length = 0;
    TriangleEdge place;
    std::uint32_t from = 0, to = 0;

    friend bool operator<(const LongEdge& a, const LongEdge& b) {
        return std::tie(a.length, b.place.triangle, b.place.edge) <
               std::tie(b.length, a.place.triangle, a.place.edge);
    }
};

/// A queue of edges, the longest first. If edges are equally long, the edge of the triangle with
/// the lowest index comes first.
class LongEdges {
public:
    LongEdges(const SurfaceMesh& mesh, double longest) : mesh_(mesh), longest_(longest) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) add(t);
    }

    void add(std::uint32_t triangle) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double size =
                length(mesh_.corner(triangle, corner_after(k)) - mesh_.corner(triangle, k));
            if (!(size > longest_)) continue;
            const auto& corners = mesh_.triangles[triangle];
            heap_.push_back({size, {triangle, k}, corners[k], corners[corner_after(k)]});
            std::push_heap(heap_.begin(), heap_.end());
        }
    }

    /// The longest edge in the queue that still exists. If the queue is empty, the result does not
    /// exist.
    TriangleEdge take() {
        while (!heap_.empty()) {
            std::pop_heap(heap_.begin(), heap_.end());
            const LongEdge edge = heap_.back();
            heap_.pop_back();
            const auto& corners = mesh_.triangles[edge.place.triangle];
            if (corners[edge.place.edge] == edge.from &&
                corners[corner_after(edge.place.edge)] == edge.to) {
                return edge.place;
            }
        }
        return {};
    }

private:
    const SurfaceMesh& mesh_;
    double longest_;
    std::vector<LongEdge> heap_;
};

}  // namespace

void Refinement::link(TriangleEdge a, TriangleEdge b) {
    if (a.exists()) mesh_.across[a.triangle][a.edge] = b;
    if (b.exists()) mesh_.across[b.triangle][b.edge] = a;
}

std::uint32_t Refinement::cut_triangle(TriangleEdge edge, std::uint32_t middle) {
    const auto [t, k] = edge;
    const auto u = static_cast<std::uint32_t>(mesh_.triangles.size());
    // In each part, the new point replaces the corner that belongs to the other part.
    mesh_.triangles.push_back(mesh_.triangles[t]);
    mesh_.triangles[u][k] = middle;
    mesh_.triangles[t][corner_after(k)] = middle;
    mesh_.across.push_back({});
    link({u, corner_after(k)}, mesh_.across[t][corner_after(k)]);
    link({t, corner_after(k)}, {u, corner_before(k)});
    const auto number = static_cast<std::uint32_t>(cuts_.size());
    cuts_.push_back({k, u});
    Cuts& cuts = cuts_of_[t];
    (cuts.last == none ? cuts.first : cuts_[cuts.last].next) = number;
    cuts.last = number;
    cuts_of_.emplace_back();
    return u;
}

void Refinement::cut(TriangleEdge edge) {
    const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
    const auto middle = static_cast<std::uint32_t>(mesh_.points.size());
    mesh_.points.push_back((mesh_.corner(edge.triangle, edge.edge) +
                            mesh_.corner(edge.triangle, corner_after(edge.edge))) *
                           0.5);
    const std::uint32_t second = cut_triangle(edge, middle);
    if (!other.exists()) return;
    const std::uint32_t second_other = cut_triangle(other, middle);
    link(edge, {second_other, other.edge});
    link({second, edge.edge}, other);
}

Refinement::Refinement(const SurfaceMesh& mesh, double longest_edge, std::size_t most_cuts,
                       const std::atomic<bool>& cancel) {
    mesh_.points = mesh.points;
    mesh_.triangles = mesh.triangles;
    mesh_.across = mesh.across;
    cuts_of_.resize(mesh.triangles.size());
    LongEdges edges(mesh_, longest_edge);
    for (std::size_t done = 0; done < most_cuts && !cancel; ++done) {
        const TriangleEdge edge = edges.take();
        if (!edge.exists()) break;
        const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
        const auto first_new = static_cast<std::uint32_t>(mesh_.triangles.size());
        cut(edge);
        edges.add(edge.triangle);
        if (other.exists()) edges.add(other.triangle);
        for (std::uint32_t t = first_new; t < mesh_.triangles.size(); ++t) edges.add(t);
    }
}

SurfacePlace Refinement::refined(SurfacePlace place) const {
    for (std::uint32_t at = cuts_of_[place.triangle].first; at != none;) {
        const Cut& cut = cuts_[at];
        double& first = place.weights[cut.edge];
        double& second = place.weights[corner_after(cut.edge)];
        if (first >= second) {
            first -= second;
            second *= 2;
            at = cut.next;
        } else {
            second -= first;
            first *= 2;
            place.triangle = cut.second;
            at = cuts_of_[cut.second].first;
        }
    }
    return place;
}

}  // namespace cascade
