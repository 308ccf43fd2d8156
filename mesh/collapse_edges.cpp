#include "mesh/collapse_edges.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double least_cosine = 0.26;  ///< Of the angle by which a triangle may turn: 75°.
constexpr std::size_t most_neighbours = 10;

class Collapser {
public:
    Collapser(SurfaceMesh& mesh, double shortest, double longest)
        : mesh_(mesh), shortest_(shortest), longest_(longest), leaving_(leaving_edges(mesh)),
          is_gone_(mesh.triangles.size()), seen_(mesh.points.size()) {}

    void run() {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3 && !is_gone_[t]; ++k) try_edge({t, k});
        }
        leave_out_gone();
    }

private:
    std::uint32_t corner(TriangleEdge e, std::uint32_t k) const {
        return mesh_.triangles[e.triangle][(e.edge + k) % 3];
    }

    std::size_t neighbours(std::uint32_t point) const {
        std::size_t count = 0;
        around_point(mesh_, leaving_[point], [&](TriangleEdge) { ++count; });
        return count;
    }

    void try_edge(TriangleEdge edge) {
        const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
        const std::uint32_t a = corner(edge, 0), b = corner(edge, 1);
        const Vector3d apart = mesh_.points[b] - mesh_.points[a];
        if (dot(apart, apart) >= shortest_ * shortest_) return;
        if (common_neighbours(a, b) != 2) return;
        // A point of three triangles would be left with two, which lie against each other.
        if (neighbours(corner(edge, 2)) < 4 || neighbours(corner(other, 2)) < 4) return;
        if (neighbours(a) + neighbours(b) > most_neighbours + 4) return;
        const Vector3d middle = mesh_.points[a] + apart * 0.5;
        if (!stays_smooth(a, b, middle) || !stays_smooth(b, a, middle)) return;
        join(edge, other, middle);
    }

    std::size_t common_neighbours(std::uint32_t a, std::uint32_t b) {
        ++stamp_;
        around_point(mesh_, leaving_[a], [&](TriangleEdge e) { seen_[corner(e, 1)] = stamp_; });
        std::size_t count = 0;
        around_point(mesh_, leaving_[b],
                     [&](TriangleEdge e) { count += seen_[corner(e, 1)] == stamp_; });
        return count;
    }

    /// Of the triangles at `point` that stay when it moves to `to` and becomes one with `other`.
    bool stays_smooth(std::uint32_t point, std::uint32_t other, Vector3d to) const {
        bool fine = true;
        around_point(mesh_, leaving_[point], [&](TriangleEdge e) {
            const std::uint32_t b = corner(e, 1), c = corner(e, 2);
            if (b == other || c == other) return;
            const Vector3d before = mesh_.double_area_normal(e.triangle);
            const Vector3d along = mesh_.points[b] - to;
            const Vector3d after = cross(along, mesh_.points[c] - to);
            const bool turns = dot(before, after) < least_cosine * length(before) * length(after);
            // Without an area afterwards it turns nowhere, but would be of no use.
            fine = fine && !turns && length(after) > 0.02 * dot(along, along) &&
                   dot(along, along) <= longest_ * longest_;
        });
        return fine;
    }

    void join(TriangleEdge edge, TriangleEdge other, Vector3d middle) {
        const std::uint32_t a = corner(edge, 0), b = corner(edge, 1);
        std::vector<TriangleEdge> around_b;
        around_point(mesh_, leaving_[b], [&](TriangleEdge e) { around_b.push_back(e); });
        for (const TriangleEdge& e : around_b) mesh_.triangles[e.triangle][e.edge] = a;
        mesh_.points[a] = middle;
        for (const TriangleEdge& gone : {edge, other}) {
            is_gone_[gone.triangle] = true;
            const TriangleEdge first = mesh_.across[gone.triangle][(gone.edge + 1) % 3];
            const TriangleEdge second = mesh_.across[gone.triangle][(gone.edge + 2) % 3];
            mesh_.across[first.triangle][first.edge] = second;
            mesh_.across[second.triangle][second.edge] = first;
            for (const TriangleEdge& kept : {first, second}) {
                leaving_[mesh_.triangles[kept.triangle][kept.edge]] = kept;
            }
        }
    }

    void leave_out_gone() {
        std::vector<std::uint32_t> numbers(mesh_.triangles.size(), TriangleEdge::none);
        std::vector<std::uint32_t> points(mesh_.points.size(), TriangleEdge::none);
        std::uint32_t kept = 0;
        for (std::uint32_t t = 0; t < numbers.size(); ++t) {
            if (!is_gone_[t]) numbers[t] = kept++;
        }
        for (std::uint32_t t = 0; t < numbers.size(); ++t) {
            if (is_gone_[t]) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                points[mesh_.triangles[t][k]] = 0;
                TriangleEdge& other = mesh_.across[t][k];
                other.triangle = numbers[other.triangle];
            }
            mesh_.triangles[numbers[t]] = mesh_.triangles[t];
            mesh_.across[numbers[t]] = mesh_.across[t];
        }
        mesh_.triangles.resize(kept);
        mesh_.across.resize(kept);
        kept = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (points[p] == TriangleEdge::none) continue;
            mesh_.points[kept] = mesh_.points[p];
            points[p] = kept++;
        }
        mesh_.points.resize(kept);
        for (auto& triangle : mesh_.triangles) {
            for (std::uint32_t& point : triangle) point = points[point];
        }
    }

    SurfaceMesh& mesh_;
    double shortest_, longest_;
    std::vector<TriangleEdge> leaving_;
    std::vector<bool> is_gone_;        ///< Triangles that have become lines.
    std::vector<std::uint32_t> seen_;  ///< When each point was last a neighbour.
    std::uint32_t stamp_ = 0;
};

}  // namespace

std::vector<TriangleEdge> leaving_edges(const SurfaceMesh& mesh) {
    std::vector<TriangleEdge> edges(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) edges[mesh.triangles[t][k]] = {t, k};
    }
    return edges;
}

void collapse_edges(SurfaceMesh& mesh, double shortest, double longest) {
    Collapser(mesh, shortest, longest).run();
}

}  // namespace cascade
