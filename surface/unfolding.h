// Unfolding of the surface around a position into the plane of its triangle.
#pragma once

#include "mesh/flat.h"
#include "surface/anisotropy.h"

#include <span>
#include <tuple>
#include <vector>

namespace cascade {

/// The shape of every triangle relative to each of its edges: the position of the third corner
/// along the edge and to the left of the edge, as multiples of the edge's length. 48 bytes per
/// triangle. Thread-safe.
class EdgeShapes {
public:
    explicit EdgeShapes(const SurfaceMesh& mesh);

    /// The position of a triangle's third corner if its edge `edge` goes from `from` to `to`.
    Vector2d apex(TriangleEdge edge, Vector2d from, Vector2d to) const {
        const auto [along, left] = shapes_[edge.triangle][edge.edge];
        const Vector2d base = to - from;
        return {from.x + base.x * along - base.y * left, from.y + base.y * along + base.x * left};
    }

private:
    std::vector<std::array<Vector2d, 3>> shapes_;
};

/// Unfolds patches of one surface, nearest edges first, and each triangle once. Where the surface
/// is curved, triangles may overlap or leave gaps in the plane. G. Turk, "Texturing Surfaces Using
/// Reaction-Diffusion" (1992), section 4.3.2, unfolds adjacent polygons exactly and all others
/// approximately. Not thread-safe. Takes four bytes per triangle.
///
/// A path along a surface is at least as long as the straight line in space. An image in the plane
/// may be nearer, if the straight line to the image leaves the unfolded triangles. `is_image`
/// rejects such images. Triangles out of reach in space are not unfolded.
class Unfolding {
public:
    /// The surface and its shapes must outlive the unfolding.
    Unfolding(const SurfaceMesh& mesh, const EdgeShapes& shapes)
        : mesh_(mesh), shapes_(shapes), marks_(mesh.triangles.size()) {}

    struct Piece {
        std::uint32_t triangle = 0;
        FlatTriangle flat;
    };

    /// Whether a point in the plane, at distance √`square_in_plane` from the position, can be the
    /// image of a point at distance √`square_in_space`. Allows an error of a tenth, because
    /// unfolding is not exact.
    static bool is_image(double square_in_plane, double square_in_space) {
        return square_in_plane >= 0.81 * square_in_space;
    }

    /// All triangles reached by a path of at most `radius` from the position. They are laid into
    /// the plane of the position's triangle, in its frame, with the position at the origin. Valid
    /// until the next call.
    std::span<const Piece> around(const SurfacePlace& place, double radius);
    /// Does the same, but measures distances in a metric, which is given in the triangle's frame.
    std::span<const Piece> around(const SurfacePlace& place, double radius, const Stretch& metric);

    /// Whether the last patch contains all triangles that are connected with the position's
    /// triangle.
    bool is_everything() const { return is_everything_; }

    /// A triangle in the last patch; null if the patch does not contain it.
    const FlatTriangle* flat_of(std::uint32_t triangle) const {
        const std::uint32_t mark = marks_[triangle];
        return mark > first_mark_ ? &pieces_[mark - first_mark_ - 1].flat : nullptr;
    }

private:
    /// An edge to a triangle that is not yet visited. A heap has the nearest edge on top. Edges
    /// that meet in the nearest corner are equally near, and the edge found first is on top. The
    /// order is total, so that results do not depend on the library's heap.
    struct Front {
        double square = 0;  ///< The squared distance.
        std::uint32_t piece = 0, edge = 0;
        friend bool operator<(const Front& a, const Front& b) {
            return std::tie(b.square, b.piece, b.edge) < std::tie(a.square, a.piece, a.edge);
        }
    };
    template <typename Metric>
    std::span<const Piece> spread(const SurfacePlace& place, double radius, double longest,
                                  const Metric& metric);
    template <typename Metric>
    void add(std::uint32_t triangle, const FlatTriangle& flat, std::uint32_t entered, double square,
             double square_of_longest, const Metric& metric);
    double square_in_space(std::uint32_t triangle, std::uint32_t edge) const;

    const SurfaceMesh& mesh_;
    const EdgeShapes& shapes_;
    std::vector<Piece> pieces_;
    std::vector<Front> fronts_;
    Vector3d position_;  ///< The position in space around which the surface is unfolded.
    std::vector<std::uint32_t> marks_;  ///< first_mark_ + 1 + the index of the triangle's piece.
    std::uint32_t first_mark_ = 0;
    bool is_everything_ = false;
};

}  // namespace cascade
