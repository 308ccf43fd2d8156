#include "surface/improve_edges.h"

#include "surface/triangle_quality.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr double least_gain = 1e-9;   ///< Of a score: more than rounding can do.
constexpr double upside_down = 0.05;  ///< A mean cosine.

class EdgeImprover {
public:
    EdgeImprover(EditedMesh& mesh, std::span<const Vector3d> normals)
        : edited_(mesh), normals_(normals) {}

    std::size_t improve(const std::atomic<bool>& cancel) {
        for (auto t = static_cast<std::uint32_t>(mesh().triangles.size()); t-- > 0;) {
            if (!edited_.has_triangle(t)) continue;
            for (std::uint32_t k = 0; k < 3; ++k) suspects_.push_back({t, k});
        }
        std::size_t exchanged = 0;
        while (!suspects_.empty() && !cancel) {
            const TriangleEdge edge = suspects_.back();
            suspects_.pop_back();
            const TriangleEdge other = mesh().across[edge.triangle][edge.edge];
            if (!other.exists() || !is_better_exchanged(edge, other)) continue;
            edited_.exchange(edge);
            ++exchanged;
            for (const std::uint32_t t : {edge.triangle, other.triangle}) {
                for (std::uint32_t k = 1; k < 3; ++k) suspects_.push_back({t, k});
            }
        }
        return exchanged;
    }

private:
    const SurfaceMesh& mesh() const { return edited_.mesh(); }

    /// A triangle as it is or might be.
    struct Candidate {
        TriangleQuality quality;
        Vector3d direction;
    };
    Candidate candidate(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto& points = mesh().points;
        const std::array<Vector3d, 3> corners = {points[a], points[b], points[c]};
        return {quality_of(corners, {normals_[a], normals_[b], normals_[c]}),
                unit(cross(corners[1] - corners[0], corners[2] - corners[0]))};
    }

    /// Of an edge between triangles: 1 up to a right angle, 0 where they lie on each other.
    static double openness(Vector3d one, Vector3d other) { return std::min(1.0, 1 + dot(one, other)); }

    /// Of the edge that `side` is, towards what lies across it.
    double openness(const Candidate& one, TriangleEdge side) const {
        const TriangleEdge other = mesh().across[side.triangle][side.edge];
        if (!other.exists()) return 1;
        return openness(one.direction, unit(mesh().double_area_normal(other.triangle)));
    }

    bool is_better_exchanged(TriangleEdge edge, TriangleEdge other) const {
        const std::uint32_t t = edge.triangle, k = edge.edge, o = other.triangle, m = other.edge;
        const auto& here = mesh().triangles[t];
        const std::uint32_t a = here[k], b = here[(k + 1) % 3], c = here[(k + 2) % 3];
        const std::uint32_t d = mesh().triangles[o][(m + 2) % 3];
        if (c == d) return false;
        const Candidate old_first = candidate(a, b, c), old_second = candidate(b, a, d);
        const TriangleEdge bc{t, (k + 1) % 3}, ca{t, (k + 2) % 3}, ad{o, (m + 1) % 3}, db{o, (m + 2) % 3};
        const double before =
            std::min({old_first.quality.score(), old_second.quality.score(),
                      openness(old_first.direction, old_second.direction), openness(old_first, bc),
                      openness(old_first, ca), openness(old_second, ad), openness(old_second, db)});
        const Candidate first = candidate(c, d, b), second = candidate(d, c, a);
        if (std::min(first.quality.mean_cosine, second.quality.mean_cosine) <= upside_down) return false;
        const auto is_better = [&](double score) { return score > before + least_gain; };
        return is_better(first.quality.score()) && is_better(second.quality.score()) &&
               is_better(openness(first.direction, second.direction)) &&
               is_better(openness(first, bc)) && is_better(openness(first, db)) &&
               is_better(openness(second, ca)) && is_better(openness(second, ad)) &&
               !edited_.are_neighbours(c, d);
    }

    EditedMesh& edited_;
    std::span<const Vector3d> normals_;
    std::vector<TriangleEdge> suspects_;
};

}  // namespace

std::size_t improve_edges(EditedMesh& mesh, std::span<const Vector3d> normals,
                          const std::atomic<bool>& cancel) {
    return EdgeImprover(mesh, normals).improve(cancel);
}

}  // namespace cascade
