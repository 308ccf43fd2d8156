// Flips an edge if the cotangents of its two opposite angles have a negative sum. Needs only the
// lengths of edges.
#include "mesh/intrinsic_delaunay.h"

#include "mesh/flat.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// A sum of cotangents above −tolerance counts as 0, because of rounding.
constexpr double tolerance = 1e-9;
/// Limits how often an edge is checked, on average over all edges.
constexpr std::size_t most_looks = 100;

class EdgeFlipper {
public:
    explicit EdgeFlipper(const SurfaceMesh& mesh) {
        mesh_.triangles = mesh.triangles;
        mesh_.across = mesh.across;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            std::array<double, 3> lengths;
            for (std::uint32_t k = 0; k < 3; ++k) {
                lengths[k] = length(mesh.corner(t, corner_after(k)) - mesh.corner(t, k));
            }
            mesh_.lengths.push_back(lengths);
        }
    }

    IntrinsicMesh run() {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) waiting_.push_back({t, k});
        }
        std::size_t left = most_looks * waiting_.size();
        for (; !waiting_.empty() && left > 0; --left) {
            const TriangleEdge edge = waiting_.back();
            waiting_.pop_back();
            const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
            if (!other.exists() || other.triangle == edge.triangle) continue;
            if (mesh_.cotangent(edge) + mesh_.cotangent(other) >= -tolerance) continue;
            flip(edge, other);
        }
        return std::move(mesh_);
    }

private:
    /// Triangles (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a).
    void flip(TriangleEdge edge, TriangleEdge other) {
        const std::uint32_t t = edge.triangle, k = edge.edge, k1 = corner_after(k),
                            k2 = corner_after(k1);
        const std::uint32_t o = other.triangle, m = other.edge, m1 = corner_after(m),
                            m2 = corner_after(m1);
        const double diagonal = length(apex(edge) - mirrored(apex(other), mesh_.lengths[t][k]));
        if (!(diagonal > 0)) return;
        const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][k1];
        const std::uint32_t c = mesh_.triangles[t][k2], d = mesh_.triangles[o][m2];
        const double bc = mesh_.lengths[t][k1], ca = mesh_.lengths[t][k2];
        const double ad = mesh_.lengths[o][m1], db = mesh_.lengths[o][m2];
        // The neighbours across the four outer sides of the two triangles. A neighbour may itself
        // be one of the two triangles.
        std::array<TriangleEdge, 4> beyond = {mesh_.across[o][m2], mesh_.across[t][k1],
                                              mesh_.across[t][k2], mesh_.across[o][m1]};
        const std::array<TriangleEdge, 4> old = {TriangleEdge{o, m2}, {t, k1}, {t, k2}, {o, m1}};
        const std::array<TriangleEdge, 4> now = {TriangleEdge{t, 1}, {t, 2}, {o, 1}, {o, 2}};
        for (TriangleEdge& one : beyond) {
            for (std::size_t side = 0; side < 4; ++side) {
                if (one != old[side]) continue;
                one = now[side];
                break;
            }
        }
        mesh_.triangles[t] = {c, d, b};
        mesh_.triangles[o] = {d, c, a};
        mesh_.lengths[t] = {diagonal, db, bc};
        mesh_.lengths[o] = {diagonal, ca, ad};
        link({t, 0}, {o, 0});
        for (std::size_t side = 0; side < 4; ++side) {
            link(now[side], beyond[side]);
            waiting_.push_back(now[side]);
        }
    }

    void link(TriangleEdge here, TriangleEdge other) {
        mesh_.across[here.triangle][here.edge] = other;
        if (other.exists()) mesh_.across[other.triangle][other.edge] = here;
    }

    /// The position of a triangle's third corner in a frame where `edge` begins at the origin and
    /// lies on the x axis.
    Vector2d apex(TriangleEdge edge) const {
        const auto& sides = mesh_.lengths[edge.triangle];
        const double base = sides[edge.edge];
        const double right = sides[corner_after(edge.edge)], left = sides[corner_before(edge.edge)];
        const double x = (base + (left - right) * ((left + right) / base)) / 2;
        return {x, 2 * mesh_.area(edge.triangle) / base};
    }

    /// Converts the apex of the triangle across the edge to the frame of this triangle. The edge
    /// has opposite directions in the two triangles.
    static Vector2d mirrored(Vector2d apex, double base) { return {base - apex.x, -apex.y}; }

    IntrinsicMesh mesh_;
    std::vector<TriangleEdge> waiting_;
};

}  // namespace

double IntrinsicMesh::area(std::uint32_t triangle) const {
    // W. Kahan's form of Heron's formula ("Miscalculating Area and Angles of a Needle-like
    // Triangle").
    std::array<double, 3> sides = lengths[triangle];
    std::sort(sides.begin(), sides.end());
    const auto [c, b, a] = sides;
    const double product = (a + (b + c)) * std::max(0.0, c - (a - b)) / (a * a) *
                           ((c + (a - b)) * (a + (b - c)) / (a * a));
    return std::sqrt(product) * a * a / 4;
}

double IntrinsicMesh::cotangent(TriangleEdge edge) const {
    const auto& sides = lengths[edge.triangle];
    const double a = sides[edge.edge];
    const double b = sides[corner_after(edge.edge)], c = sides[corner_before(edge.edge)];
    const double four_areas = 4 * area(edge.triangle);
    const double above = b * b + (c - a) * (c + a);
    return above / std::max(four_areas, 1e-12 * (a * a + b * b + c * c));
}

IntrinsicMesh intrinsic_delaunay(const SurfaceMesh& mesh) { return EdgeFlipper(mesh).run(); }

}  // namespace cascade
