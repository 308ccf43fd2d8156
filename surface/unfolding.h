// The surface around a place, unfolded into the plane of its triangle.
#pragma once

#include "surface/flat.h"

#include <span>
#include <vector>

namespace cascade {

/// Unfolds patches of one surface, each reached triangle once, over edges near the place first. Where
/// the surface is curved triangles in the plane may overlap or leave gaps; G. Turk, "Texturing
/// Surfaces Using Reaction-Diffusion" (1992), section 4.3.2, unfolds adjacent polygons exactly and others
/// approximately. One object serves one thread at a time; it keeps four bytes a triangle.
class Unfolding {
public:
    explicit Unfolding(const SurfaceMesh& mesh)
        : mesh_(mesh), marks_(mesh.triangles.size()) {}

    struct Piece {
        std::uint32_t triangle = 0;
        FlatTriangle flat;
    };

    /// All triangles within `radius` of the place, which is the origin; directions are those of the frame
    /// of its triangle. Valid until the next call.
    std::span<const Piece> around(const SurfacePlace& place, double radius);

    /// Where another place lies in the patch that was unfolded last; null if it is not in it.
    const FlatTriangle* flat_of(std::uint32_t triangle) const {
        const std::uint32_t mark = marks_[triangle];
        return mark > first_mark_ ? &pieces_[mark - first_mark_ - 1].flat : nullptr;
    }

private:
    /// An edge beyond which lies a triangle that has not been looked at.
    struct Front {
        double distance = 0;
        TriangleEdge into;
        Vector2d from, to;
        friend bool operator<(const Front& a, const Front& b) { return a.distance > b.distance; }
    };
    void add(std::uint32_t triangle, const FlatTriangle& flat, std::uint32_t entered, double radius);

    const SurfaceMesh& mesh_;
    std::vector<Piece> pieces_;
    std::vector<Front> fronts_;           ///< A heap; the nearest comes out first.
    std::vector<std::uint32_t> marks_;    ///< first_mark_ + 1 + its piece for triangles in the patch.
    std::uint32_t first_mark_ = 0;
};

}  // namespace cascade
