// The surface around a place, unfolded into the plane of its triangle.
#pragma once

#include "mesh/flat.h"

#include <span>
#include <vector>

namespace cascade {

/// The shape of every triangle as it is seen from each of its edges: where the third corner lies,
/// in lengths of the edge, along it and to its left. 48 bytes a triangle; for all threads.
class EdgeShapes {
public:
    explicit EdgeShapes(const SurfaceMesh& mesh);

    /// The third corner of a triangle whose edge goes from `from` to `to`.
    Vector2d apex(TriangleEdge edge, Vector2d from, Vector2d to) const {
        const auto [along, left] = shapes_[edge.triangle][edge.edge];
        const Vector2d base = to - from;
        return {from.x + base.x * along - base.y * left, from.y + base.y * along + base.x * left};
    }

private:
    std::vector<std::array<Vector2d, 3>> shapes_;
};

/// Unfolds patches of one surface, each reached triangle once, over edges near the place first.
/// Where the surface is curved triangles in the plane may overlap or leave gaps; G. Turk,
/// "Texturing Surfaces Using Reaction-Diffusion" (1992), section 4.3.2, unfolds adjacent polygons
/// exactly and others approximately. One object serves one thread at a time; it keeps four bytes a
/// triangle.
///
/// No way along a surface is shorter than the straight one, but an image in the plane may be
/// nearer, where the straight line to it leaves the unfolded triangles: `is_image` tells those that
/// mean nothing, and what lies out of reach in space is not unfolded at all.
class Unfolding {
public:
    /// The surface and its shapes must stay as long as the unfolding is used.
    Unfolding(const SurfaceMesh& mesh, const EdgeShapes& shapes)
        : mesh_(mesh), shapes_(shapes), marks_(mesh.triangles.size()) {}

    struct Piece {
        std::uint32_t triangle = 0;
        FlatTriangle flat;
    };

    /// Whether what lies in the plane at a distance of this square from the place can be the image
    /// of what lies in space at one of that square. A tenth is allowed for, as unfolding is not
    /// exact.
    static bool is_image(double square_in_plane, double square_in_space) {
        return square_in_plane >= 0.81 * square_in_space;
    }

    /// All triangles that a way no longer than `radius` reaches from the place, which is the
    /// origin; directions are those of the frame of its triangle. Valid until the next call.
    std::span<const Piece> around(const SurfacePlace& place, double radius);

    /// Of the patch that was unfolded last: is it all that is connected with the place?
    bool is_everything() const { return is_everything_; }

    /// Where another place lies in the patch that was unfolded last; null if it is not in it.
    const FlatTriangle* flat_of(std::uint32_t triangle) const {
        const std::uint32_t mark = marks_[triangle];
        return mark > first_mark_ ? &pieces_[mark - first_mark_ - 1].flat : nullptr;
    }

private:
    /// An edge beyond which lies a triangle that has not been looked at. A heap of them has the
    /// nearest on top.
    struct Front {
        double square = 0;  ///< Of its distance.
        std::uint32_t piece = 0, edge = 0;
        friend bool operator<(const Front& a, const Front& b) { return a.square > b.square; }
    };
    void add(std::uint32_t triangle, const FlatTriangle& flat, std::uint32_t entered,
             double square);
    double square_in_space(std::uint32_t triangle, std::uint32_t edge) const;

    const SurfaceMesh& mesh_;
    const EdgeShapes& shapes_;
    std::vector<Piece> pieces_;
    std::vector<Front> fronts_;
    Vector3d position_;                 ///< Of the place.
    std::vector<std::uint32_t> marks_;  ///< first_mark_ + 1 + its piece for triangles in the patch.
    std::uint32_t first_mark_ = 0;
    bool is_everything_ = false;
};

}  // namespace cascade
