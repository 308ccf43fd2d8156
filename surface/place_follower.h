// Finds the nearest positions on a surface to points that move a little at a time.
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

/// Goes from triangle to triangle, starting at the triangle found last, as long as a triangle that
/// shares a corner is nearer to the point. This takes a few dozen nanoseconds, where NearestPlace
/// takes a microsecond. The position found is nearer than all positions around it. It is the
/// nearest on the whole surface unless the point has come nearer to another sheet of the surface.
/// If several positions are equally near, the one on the triangle with the lowest index is found.
/// The mesh must have triangles and outlive the object unchanged. Thread-safe.
class PlaceFollower {
public:
    explicit PlaceFollower(const SurfaceMesh& mesh);

    struct Found {
        SurfacePlace place;
        Vector3d position;
        double distance = 0;     ///< The distance of the point from the position.
        bool is_border = false;  ///< Whether the position is on a boundary of the surface.
    };
    /// Starts at `from`, the triangle of an earlier position. Searches the whole surface if there
    /// is no such triangle, if the way is long, or if the way ends at a boundary, because another
    /// part of the surface beyond the boundary may be nearer. nullopt if the point is not finite.
    std::optional<Found> find(Vector3d point, std::uint32_t from) const;

    /// Prefetches the data that stay() needs.
    void prepare(std::uint32_t triangle) const {
        if (triangle >= triangles_.size()) return;
        const Inside* const inside = insides_.data() + triangle;
        __builtin_prefetch(inside);
        __builtin_prefetch(reinterpret_cast<const char*>(inside) + 64);
    }
    /// A point above or below the inside of a triangle.
    struct Over {
        std::array<double, 3> weights;
        double height = 0;  ///< The height of the point above the triangle.
        Vector3d normal;    ///< The triangle's normal, of length 1.
        std::uint32_t triangle = 0;
    };
    /// A faster find() for points whose nearest position is inside the triangle `from` or a
    /// triangle next to it. Returns nullopt for other points.
    std::optional<Over> stay(Vector3d point, std::uint32_t from) const {
        for (int moves = 0; moves <= most_moves_of_stay && from < triangles_.size(); ++moves) {
            const Inside& inside = insides_.data()[from];
            Over over = inside.over(point);
            over.triangle = from;
            if (inside.is_nearest(over)) return over;
            const std::size_t corner = inside.farthest_edge(over);
            // Here the point is too near to an edge, or not finite.
            if (!(over.weights[corner] < 0)) return std::nullopt;
            from = inside.across[corner];
        }
        return std::nullopt;
    }

    /// The results of stay() for several points, in separate arrays, so that compilers vectorise
    /// the computation.
    struct AllOver {
        static constexpr std::size_t most = 8;
        using Numbers = std::array<double, most>;
        std::array<Numbers, 3> weights, normals;  ///< Weights by corner, normals by component.
        Numbers heights;
        std::array<std::uint32_t, most> triangles;
        std::array<bool, most> is_over{};  ///< False where stay() found nothing.
    };
    /// Calls stay() for several points, at most as many as AllOver has room for.
    void stay(std::span<const Vector3d> points, std::span<const std::uint32_t> from,
              AllOver& all) const;

private:
    static constexpr int most_moves_of_stay = 2;
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    /// The data of a triangle for points near it, side by side in memory.
    struct alignas(64) Inside {
        Vector3d corner;  ///< The position of corner 0.
        /// The gradients of the second and the third corner's weights.
        Vector3d of_second, of_third;
        Vector3d normal;                 ///< Of length 1; 0 if the triangle has no area.
        std::array<float, 3> heights{};  ///< The height of each corner over its opposite edge.
        /// The steepness of the surrounding triangles on the side of the normal, and on the other
        /// side: see steepness_around().
        std::array<float, 2> steepness{};
        /// For each corner, the triangle over the opposite edge.
        std::array<std::uint32_t, 3> across{};

        Over over(Vector3d point) const {
            const Vector3d at = point - corner;
            const double second = dot(of_second, at), third = dot(of_third, at);
            return {{1 - second - third, second, third}, dot(normal, at), normal, 0};
        }
        /// The corner opposite the edge beyond which the point is farthest.
        std::size_t farthest_edge(const Over& over) const {
            std::array<double, 3> within{};
            for (std::size_t k = 0; k < 3; ++k) within[k] = double{heights[k]} * over.weights[k];
            return static_cast<std::size_t>(std::min_element(within.begin(), within.end()) -
                                            within.begin());
        }
        /// Whether the position in this triangle is nearer than all positions on the surrounding
        /// triangles. For this, the surrounding triangles must rise towards the point less steeply
        /// than the ball around the point that touches this triangle. Returns false very near to an
        /// edge, where rounding could decide.
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
        /// The distance, in the triangle's plane, of a point with these weights from the nearest
        /// edge, reduced slightly to allow for rounding.
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
        /// For each corner, whether the opposite edge is at a boundary.
        std::array<bool, 3> is_open{};
        std::array<bool, 3> is_rim{};  ///< Whether each corner is at a boundary.
    };
    struct Near {
        std::uint32_t triangle = 0;
        bool is_inside = false;  ///< Whether the position is inside the triangle, not on an edge.
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
    AlignedArray<Inside> insides_;  ///< The data of each triangle. Many share a page of memory.
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> ends_;  ///< The triangles around t end before around_[ends_[t]].
    std::vector<std::uint32_t>
        around_;  ///< The triangles that share a corner with each triangle, ascending.
};

}  // namespace cascade
