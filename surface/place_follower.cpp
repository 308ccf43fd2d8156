// Goes downhill over the triangles around the last place.
#include "surface/place_follower.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// After this many triangles the tree is faster.
constexpr int most_moves = 24;

std::vector<std::vector<std::uint32_t>> triangles_at_points(const SurfaceMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> at(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t point : mesh.triangles[t]) at[point].push_back(t);
    }
    return at;
}

}  // namespace

PlaceFollower::PlaceFollower(const SurfaceMesh& mesh) : all_(mesh) {
    CHECK(!mesh.triangles.empty(), "a surface has triangles");
    const auto at_points = triangles_at_points(mesh);
    std::vector<bool> is_rim(mesh.points.size(), false);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (mesh.across[t][k].exists()) continue;
            is_rim[mesh.triangles[t][k]] = is_rim[mesh.triangles[t][corner_after(k)]] = true;
        }
    }
    std::vector<std::uint32_t> around;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        around.clear();
        for (const std::uint32_t point : mesh.triangles[t]) {
            around.insert(around.end(), at_points[point].begin(), at_points[point].end());
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        const Vector3d normal = mesh.double_area_normal(t);
        Triangle triangle;
        triangle.is_smooth = true;
        for (const std::uint32_t other : around) {
            triangle.is_smooth =
                triangle.is_smooth && dot(normal, mesh.double_area_normal(other)) > 0;
            if (other != t) around_.push_back(other);
        }
        ends_.push_back(static_cast<std::uint32_t>(around_.size()));
        for (std::uint32_t k = 0; k < 3; ++k) {
            triangle.corners[k] = mesh.corner(t, k);
            triangle.is_open[k] = !mesh.across[t][corner_after(k)].exists();
            triangle.is_rim[k] = is_rim[mesh.triangles[t][k]];
            const double edge =
                length(mesh.corner(t, corner_before(k)) - mesh.corner(t, corner_after(k)));
            triangle.heights[k] = edge > 0 ? length(normal) / edge : 0;
        }
        triangle.middle =
            (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) * (1.0 / 3);
        for (const Vector3d& corner : triangle.corners) {
            triangle.radius = std::max(triangle.radius, length(corner - triangle.middle));
        }
        triangles_.push_back(triangle);
    }
}

PlaceFollower::Near PlaceFollower::measured(std::uint32_t number, Vector3d point) const {
    const std::array<Vector3d, 3>& corners = triangles_[number].corners;
    const std::array<double, 3> weights = nearest_weights(corners, point);
    const Vector3d apart =
        (corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]) - point;
    return {number, dot(apart, apart), weights};
}

/// Where no triangle around is folded over this one, they are all beyond its edges.
bool PlaceFollower::is_nearest_around(const Near& near) const {
    const Triangle& triangle = triangles_[near.triangle];
    double to_edge = triangle.heights[0] * near.weights[0];
    for (std::size_t k = 1; k < 3; ++k) {
        to_edge = std::min(to_edge, triangle.heights[k] * near.weights[k]);
    }
    return triangle.is_smooth && near.square < to_edge * to_edge;
}

PlaceFollower::Found PlaceFollower::found(const Near& near) const {
    const Triangle& triangle = triangles_[near.triangle];
    Found result;
    result.place = {near.triangle, near.weights};
    for (std::size_t k = 0; k < 3; ++k) {
        result.position = result.position + triangle.corners[k] * near.weights[k];
        result.is_border = result.is_border || (near.weights[k] == 0 && triangle.is_open[k]) ||
                           (near.weights[k] == 1 && triangle.is_rim[k]);
    }
    return result;
}

std::optional<PlaceFollower::Found> PlaceFollower::find(Vector3d point, std::uint32_t from) const {
    if (!is_finite(point)) return std::nullopt;
    if (from < triangles_.size()) {
        Near best = measured(from, point);
        for (int move = 0; move < most_moves; ++move) {
            const std::uint32_t before = best.triangle;
            if (!is_nearest_around(best)) {
                const std::uint32_t first = before == 0 ? 0 : ends_[before - 1];
                for (std::uint32_t k = first; k < ends_[before]; ++k) {
                    const Triangle& other = triangles_[around_[k]];
                    const Vector3d apart = other.middle - point;
                    const double reached = std::sqrt(best.square) + other.radius;
                    if (dot(apart, apart) > reached * reached * (1 + 1e-12)) continue;
                    const Near near = measured(around_[k], point);
                    if (near.square < best.square ||
                        (near.square == best.square && near.triangle < best.triangle)) {
                        best = near;
                    }
                }
            }
            if (best.triangle != before) continue;
            const Found result = found(best);
            if (result.is_border) break;
            return result;
        }
    }
    const std::optional<SurfacePlace> place = all_.find(point);
    CHECK(place.has_value(), "a surface has a nearest place");
    return found(measured(place->triangle, point));
}

}  // namespace cascade
