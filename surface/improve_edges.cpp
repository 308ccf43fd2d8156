#include "surface/improve_edges.h"

#include "mesh/flat.h"
#include "surface/triangle_quality.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double least_gain = 1e-9;   ///< Of a score: more than rounding can do.
constexpr double upside_down = 0.05;  ///< A mean cosine.

}  // namespace

void EdgeImprover::improve(const std::atomic<bool>& cancel) {
    look_at_changed();
    while (!suspects_.empty() && !cancel) {
        const TriangleEdge edge = suspects_.back();
        suspects_.pop_back();
        const TriangleEdge other = mesh().across[edge.triangle][edge.edge];
        if (!other.exists() || !is_better_exchanged(edge, other)) continue;
        edited_.exchange(edge);
        look_at_changed();
    }
}

void EdgeImprover::look_at_changed() {
    faces_.resize(mesh().triangles.size());
    for (const std::uint32_t t : edited_.take_changed()) {
        if (!edited_.has_triangle(t)) continue;
        const auto [a, b, c] = mesh().triangles[t];
        faces_[t] = face(a, b, c);
        for (std::uint32_t k = 0; k < 3; ++k) suspects_.push_back({t, k});
    }
}

EdgeImprover::Face EdgeImprover::face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto& points = mesh().points;
    const TriangleQuality quality =
        quality_of({points[a], points[b], points[c]}, {normals_[a], normals_[b], normals_[c]});
    return {quality.score(), quality.mean_cosine > upside_down,
            unit(cross(points[b] - points[a], points[c] - points[a]))};
}

/// Of an edge between triangles: 1 up to a right angle, 0 where they lie on each other.
double EdgeImprover::openness(const Face& one, const Face& other) {
    return std::min(1.0, 1 + dot(one.direction, other.direction));
}

/// Between a triangle and what lies across a side that it has.
double EdgeImprover::openness(const Face& one, TriangleEdge side) const {
    const TriangleEdge other = mesh().across[side.triangle][side.edge];
    return other.exists() ? openness(one, faces_[other.triangle]) : 1;
}

/// Whether the worst of two triangles, their edge and their four sides becomes better.
bool EdgeImprover::is_better_exchanged(TriangleEdge edge, TriangleEdge other) const {
    const std::uint32_t t = edge.triangle, k = edge.edge, o = other.triangle, m = other.edge;
    const auto& here = mesh().triangles[t];
    const std::uint32_t a = here[k], b = here[corner_after(k)], c = here[corner_before(k)];
    const std::uint32_t d = mesh().triangles[o][corner_before(m)];
    if (c == d) return false;
    const Face first = face(c, d, b), second = face(d, c, a);
    if (!first.is_upright || !second.is_upright) return false;
    const TriangleEdge bc{t, corner_after(k)}, ca{t, corner_before(k)};
    const TriangleEdge ad{o, corner_after(m)}, db{o, corner_before(m)};
    const double before = std::min(
        {faces_[t].score, faces_[o].score, openness(faces_[t], faces_[o]), openness(faces_[t], bc),
         openness(faces_[t], ca), openness(faces_[o], ad), openness(faces_[o], db)});
    const double behind =
        std::min({first.score, second.score, openness(first, second), openness(first, bc),
                  openness(first, db), openness(second, ca), openness(second, ad)});
    return behind > before + least_gain && !edited_.are_neighbours(c, d);
}

}  // namespace cascade
