// Goes from triangle to nearer triangle, starting at the previous position.
#include "surface/place_follower.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {
namespace {

/// If a search visits more triangles than this, a search in the tree is faster.
constexpr int most_moves = 24;

std::vector<std::vector<std::uint32_t>> triangles_at_points(const SurfaceMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> at(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t point : mesh.triangles[t]) at[point].push_back(t);
    }
    return at;
}

}  // namespace

PlaceFollower::PlaceFollower(const SurfaceMesh& mesh)
    : all_(mesh), insides_(mesh.triangles.size()) {
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
        around.erase(std::find(around.begin(), around.end(), t));
        around_.insert(around_.end(), around.begin(), around.end());
        ends_.push_back(static_cast<std::uint32_t>(around_.size()));
        insides_.data()[t] = inside_of(mesh, t);
        insides_.data()[t].steepness = steepness_around(mesh, t, around);
        Triangle triangle;
        for (std::uint32_t k = 0; k < 3; ++k) {
            triangle.corners[k] = mesh.corner(t, k);
            triangle.is_open[k] = !mesh.across[t][corner_after(k)].exists();
            triangle.is_rim[k] = is_rim[mesh.triangles[t][k]];
        }
        triangles_.push_back(triangle);
    }
}

/// The data of a triangle. A triangle without area is stored so that no point counts as inside.
PlaceFollower::Inside PlaceFollower::inside_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    Inside inside;
    inside.corner = mesh.corner(triangle, 0);
    for (std::uint32_t k = 0; k < 3; ++k) {
        inside.across[k] = mesh.across[triangle][corner_after(k)].triangle;
    }
    const Vector3d normal = mesh.double_area_normal(triangle);
    const double inverse = 1 / dot(normal, normal);
    if (!std::isfinite(inverse)) return inside;
    const Vector3d second = mesh.corner(triangle, 1) - inside.corner;
    const Vector3d third = mesh.corner(triangle, 2) - inside.corner;
    inside.of_second = cross(third, normal) * inverse;
    inside.of_third = cross(normal, second) * inverse;
    inside.normal = unit(normal);
    const Vector3d of_first = -inside.of_second - inside.of_third;
    const std::array gradients{of_first, inside.of_second, inside.of_third};
    for (std::size_t k = 0; k < 3; ++k) {
        inside.heights[k] = static_cast<float>(1 / length(gradients[k]));
    }
    return inside;
}

/// The steepness of the surrounding triangles on each side of this triangle. A point of a
/// surrounding triangle has a height over this triangle's plane and, in this plane, a distance from
/// this triangle. The result is the largest ratio of height to distance, but at most 1. A larger
/// ratio needs no larger result: no triangle bent by less than 90° comes nearer to a point whose
/// height is less than its distance from the edges. Infinite if a triangle is bent by 90° or more.
/// Almost all surrounding triangles are beyond the line of an edge or beyond a corner. Height and
/// distance are linear there, so it is enough to test corners.
std::array<float, 2> PlaceFollower::steepness_around(const SurfaceMesh& mesh,
                                                     std::uint32_t triangle,
                                                     std::span<const std::uint32_t> around) const {
    const Inside& inside = insides_.data()[triangle];
    const std::array<std::uint32_t, 3> own = mesh.triangles[triangle];
    const std::array outward{unit(inside.of_second + inside.of_third), -unit(inside.of_second),
                             -unit(inside.of_third)};
    // Outward directions: first the directions across the three edges, numbered by the opposite
    // corner, then the directions at the three corners.
    std::array<Vector3d, 6> directions;
    for (std::uint32_t k = 0; k < 3; ++k) {
        directions[k] = outward[k];
        directions[3 + k] = unit(outward[corner_after(k)] + outward[corner_before(k)]);
    }
    std::array<double, 2> most{};
    for (const std::uint32_t other : around) {
        const bool is_flat = dot(inside.normal, mesh.double_area_normal(other)) > 0;
        if (!is_flat) return {INFINITY, INFINITY};
        std::array<double, 2> of_other{1, 1};
        for (std::uint32_t k = 0; k < 6; ++k) {
            const std::uint32_t corner = k % 3;
            const Vector3d from = mesh.corner(triangle, k < 3 ? corner_after(corner) : corner);
            std::array<double, 2> steepest{};
            for (const std::uint32_t point : mesh.triangles[other]) {
                const auto shared = std::find(own.begin(), own.end(), point) - own.begin();
                if (shared < 3 && (shared == corner) == (k >= 3)) continue;
                const Vector3d at = mesh.points[point] - from;
                const double beyond = dot(directions[k], at), height = dot(inside.normal, at);
                for (const std::size_t side : {0, 1}) {
                    const double rise = std::max(0.0, side == 0 ? height : -height);
                    steepest[side] = std::max(steepest[side], beyond > 0 ? rise / beyond : 1);
                }
            }
            for (const std::size_t side : {0, 1}) {
                of_other[side] = std::min(of_other[side], steepest[side]);
            }
        }
        for (const std::size_t side : {0, 1}) most[side] = std::max(most[side], of_other[side]);
    }
    constexpr double rounding = 1 + 1e-6;
    return {static_cast<float>(most[0] * rounding), static_cast<float>(most[1] * rounding)};
}

/// The nearest position on a triangle. If the squared distance exceeds `most`, the result may have
/// an infinite distance.
PlaceFollower::Near PlaceFollower::measured(std::uint32_t number, Vector3d point,
                                            double most) const {
    const Inside& inside = insides_.data()[number];
    const Over over = inside.over(point);
    const auto& [first, second, third] = over.weights;
    const double square = over.height * over.height;
    if (first > 0 && second > 0 && third > 0) {
        return {number, true, square, over.height, over.weights};
    }
    // The greatest distance by which the point is beyond the line of an edge. The triangle itself
    // is on the other side of this line.
    const double beyond =
        std::max({-first * double{inside.heights[0]}, -second * double{inside.heights[1]},
                  -third * double{inside.heights[2]}});
    constexpr double rounding = 1 - 1e-6;
    if ((square + beyond * beyond) * rounding > most) {
        return {number, false, infinity, 0, {}};
    }
    const std::array<Vector3d, 3>& corners = triangles_[number].corners;
    const std::array<double, 3> weights = nearest_weights(corners, point);
    const Vector3d apart =
        (corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]) - point;
    return {number, false, dot(apart, apart), 0, weights};
}

PlaceFollower::Found PlaceFollower::found(const Near& near, Vector3d point) const {
    Found result;
    result.place = {near.triangle, near.weights};
    if (near.is_inside) {
        result.position = point - insides_.data()[near.triangle].normal * near.height;
        result.distance = std::abs(near.height);
        return result;
    }
    const Triangle& triangle = triangles_[near.triangle];
    result.distance = std::sqrt(near.square);
    for (std::size_t k = 0; k < 3; ++k) {
        result.position = result.position + triangle.corners[k] * near.weights[k];
        result.is_border = result.is_border || (near.weights[k] == 0 && triangle.is_open[k]) ||
                           (near.weights[k] == 1 && triangle.is_rim[k]);
    }
    return result;
}

void PlaceFollower::stay(std::span<const Vector3d> points, std::span<const std::uint32_t> from,
                         AllOver& all) const {
    constexpr std::size_t most = AllOver::most;
    using Numbers = AllOver::Numbers;
    std::array<Numbers, 3> at, second, third, heights;
    for (std::size_t k = 0; k < most; ++k) {
        // Lanes without a point repeat the first point.
        const std::size_t n = k < points.size() ? k : 0;
        const std::uint32_t triangle = from[n] < triangles_.size() ? from[n] : 0;
        const Inside& inside = insides_.data()[triangle];
        const auto put = [k](std::array<Numbers, 3>& to, Vector3d v) {
            to[0][k] = v.x;
            to[1][k] = v.y;
            to[2][k] = v.z;
        };
        put(at, points[n] - inside.corner);
        put(second, inside.of_second);
        put(third, inside.of_third);
        put(all.normals, inside.normal);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            heights[corner][k] = double{inside.heights[corner]};
        }
        all.triangles[k] = triangle;
    }
    Numbers to_edge;
    for (std::size_t k = 0; k < most; ++k) {
        const auto dot_with_at = [&](const std::array<Numbers, 3>& v) {
            return v[0][k] * at[0][k] + v[1][k] * at[1][k] + v[2][k] * at[2][k];
        };
        all.weights[1][k] = dot_with_at(second);
        all.weights[2][k] = dot_with_at(third);
        all.weights[0][k] = 1 - all.weights[1][k] - all.weights[2][k];
        all.heights[k] = dot_with_at(all.normals);
        to_edge[k] = Inside::to_edge({heights[0][k], heights[1][k], heights[2][k]},
                                     {all.weights[0][k], all.weights[1][k], all.weights[2][k]});
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Inside& inside = insides_.data()[all.triangles[k]];
        all.is_over[k] =
            from[k] < triangles_.size() && inside.is_nearest(all.heights[k], to_edge[k]);
        if (all.is_over[k]) continue;
        const std::optional<Over> over = stay(points[k], from[k]);
        if (!over) continue;
        all.is_over[k] = true;
        all.triangles[k] = over->triangle;
        all.heights[k] = over->height;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            all.weights[corner][k] = over->weights[corner];
        }
        all.normals[0][k] = over->normal.x;
        all.normals[1][k] = over->normal.y;
        all.normals[2][k] = over->normal.z;
    }
}

std::optional<PlaceFollower::Found> PlaceFollower::find(Vector3d point, std::uint32_t from) const {
    if (!is_finite(point)) return std::nullopt;
    if (from < triangles_.size()) {
        Near best = measured(from, point);
        for (int move = 0; move < most_moves; ++move) {
            const std::uint32_t before = best.triangle;
            const bool is_nearest = best.is_inside && insides_.data()[before].is_nearest(
                                                          {best.weights, best.height, {}, before});
            if (!is_nearest) {
                const std::uint32_t first = before == 0 ? 0 : ends_[before - 1];
                for (std::uint32_t k = first; k < ends_[before]; ++k) {
                    const Near near = measured(around_[k], point, best.square);
                    if (near.square < best.square ||
                        (near.square == best.square && near.triangle < best.triangle)) {
                        best = near;
                    }
                }
            }
            if (best.triangle != before) continue;
            const Found result = found(best, point);
            if (result.is_border) break;
            return result;
        }
    }
    const std::optional<SurfacePlace> place = all_.find(point);
    CHECK(place.has_value(), "a surface has a nearest place");
    return found(measured(place->triangle, point), point);
}

}  // namespace cascade
