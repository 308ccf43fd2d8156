// The nearest positions on a surface to points that move a little at a time.
#pragma once

#include "core/links.h"
#include "surface/nearest_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Moves from triangle to triangle as long as one that shares a corner is nearer, which takes a few
/// dozen nanoseconds where NearestPlace takes a microsecond. The position found is nearer than all
/// others around it, and nearest of all if no other sheet of the surface has come nearer meanwhile.
/// Of equally near positions it is the one on the triangle with the lowest index. The mesh must
/// have triangles and outlive it unchanged. Thread-safe.
class PlaceFollower {
public:
    explicit PlaceFollower(const SurfaceMesh& mesh);

    struct Found {
        SurfacePlace place;
        Vector3d position;
        double distance = 0;     ///< The distance of the point from the position.
        bool is_border = false;  ///< The position is on a boundary of the surface.
    };
    /// Starts at the triangle of an earlier position. Without one, after a long way, and where the
    /// way ends at a boundary, beyond which another part may be nearer, finds the nearest position
    /// of all. Empty if the point is not finite.
    std::optional<Found> find(Vector3d point, std::uint32_t from) const;

    /// Brings the data of stay() into the cache.
    void prepare(std::uint32_t triangle) const {
        if (triangle >= triangles_.size()) return;
        const Inside* const inside = insides_.data() + triangle;
        __builtin_prefetch(inside);
        __builtin_prefetch(reinterpret_cast<const char*>(inside) + 64);
    }
    /// A point over the inside of a triangle.
    struct Over {
        std::array<double, 3> weights;
        double height = 0;  ///< Above the triangle.
        Vector3d normal;    ///< The triangle's normal, of length 1.
        std::uint32_t triangle = 0;
    };
    /// The result of find() at once, if it is inside the triangle `from` or one next to it. Empty
    /// elsewhere.
    std::optional<Over> stay(Vector3d point, std::uint32_t from) const {
        for (int moves = 0; moves <= most_moves_of_stay && from < triangles_.size(); ++moves) {
            const Inside& inside = insides_.data()[from];
            Over over = inside.over(point);
            over.triangle = from;
            if (inside.is_nearest(over)) return over;
            const std::size_t corner = inside.farthest_edge(over);
            // Too near to an edge, or not finite.
            if (!(over.weights[corner] < 0)) return std::nullopt;
            from = inside.across[corner];
        }
        return std::nullopt;
    }

    /// The results of stay() for several points, side by side so that compilers vectorise them.
    struct AllOver {
        static constexpr std::size_t most = 8;
        using Numbers = std::array<double, most>;
        std::array<Numbers, 3> weights, normals;  ///< By corner and by component.
        Numbers heights;
        std::array<std::uint32_t, most> triangles;
        std::array<bool, most> is_over{};  ///< False if nothing was found.
    };
    /// For at most as many points as AllOver has room for.
    void stay(std::span<const Vector3d> points, std::span<const std::uint32_t> from,
              AllOver& all) const;

private:
    static constexpr int most_moves_of_stay = 2;
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    /// The data of a triangle for points near it, side by side in memory.
    struct alignas(64) Inside {
        Vector3d corner;                 ///< The first one.
        Vector3d of_second, of_third;    ///< The gradients of these corners' weights.
        Vector3d normal;                 ///< Of length 1. 0 if there is no area.
        std::array<float, 3> heights{};  ///< The height of each corner over its opposite edge.
        /// How steeply the triangles around rise on the side of the normal and on the other side:
        /// see steepness_around().
        std::array<float, 2> steepness{};
        std::array<std::uint32_t, 3> across{};  ///< By corner: the triangle over the opposite edge.

        Over over(Vector3d point) const {
            const Vector3d at = point - corner;
            const double second = dot(of_second, at), third = dot(of_third, at);
            return {{1 - second - third, second, third}, dot(normal, at), normal, 0};
        }
        /// The corner opposite the edge that the point is farthest beyond.
        std::size_t farthest_edge(const Over& over) const {
            std::array<double, 3> within{};
            for (std::size_t k = 0; k < 3; ++k) within[k] = double{heights[k]} * over.weights[k];
            return static_cast<std::size_t>(std::min_element(within.begin(), within.end()) -
                                            within.begin());
        }
        /// Whether no position on the triangles around is nearer. They are all beyond the edges,
        /// and rise towards the point more slowly than a ball around it that touches this one. Very
        /// near to an edge, where rounding could decide, the answer is no.
        bool is_nearest(const Over& over) const {
            return is_nearest(over.height,
                              to_edge({double{heights[0]}, double{heights[1]}, double{heights[2]}},
                                      over.weights));
        }
        bool is_nearest(double height, double to_edge) const {
            constexpr double rounding = 1 - 1e-6;
            const double steep = double{steepness[height < 0 ? 1 : 0]};
            return steep * std::abs(height) < to_edge * rounding;
        }
        /// Slightly less than the inward distance from the nearest edge of a point with these
        /// weights.
        static double to_edge(const std::array<double, 3>& heights,
                              const std::array<double, 3>& weights) {
            constexpr double edge = 1e-9;
            const double first = heights[0] * (weights[0] - edge);
            const double second = heights[1] * (weights[1] - edge);
            const double third = heights[2] * (weights[2] - edge);
            return std::min(std::min(first, second), third);
        }
    };
    struct Triangle {
        std::array<Vector3d, 3> corners;
        std::array<bool, 3> is_open{};  ///< By corner: the opposite edge is at a boundary.
        std::array<bool, 3> is_rim{};   ///< By corner: it is at a boundary.
    };
    struct Near {
        std::uint32_t triangle = 0;
        bool is_inside = false;  ///< The position is not on an edge.
        double square = 0;       ///< The squared distance.
        double height = 0;       ///< The point's height above the triangle, if `is_inside`.
        std::array<double, 3> weights{};
    };
    static Inside inside_of(const SurfaceMesh& mesh, std::uint32_t triangle);
    std::array<float, 2> steepness_around(const SurfaceMesh& mesh, std::uint32_t triangle,
                                          std::span<const std::uint32_t> around) const;
    Near measured(std::uint32_t triangle, Vector3d point, double most = infinity) const;
    Found found(const Near& near, Vector3d point) const;

    NearestPlace all_;
    AlignedArray<Inside> insides_;  ///< By triangle, many per page of memory.
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> ends_;  ///< The triangles around t end before around_[ends_[t]].
    std::vector<std::uint32_t>
        around_;  ///< The triangles that share a corner with each, ascending.
};

}  // namespace cascade
