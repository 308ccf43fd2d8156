// Surfaces on which lengths count differently along and across a direction.
#pragma once

#include "mesh/flat.h"

#include <vector>

namespace cascade {

/// A symmetric matrix of determinant 1 that takes vectors of a plane to vectors whose lengths are
/// those that count. It keeps areas.
struct Stretch {
    double xx = 1, xy = 0, yy = 1;

    /// 1/√ratio along a direction of the plane, √ratio across: what is a circle afterwards was an
    /// ellipse `ratio` times as long as wide.
    static Stretch along(Vector2d direction, double ratio);

    Vector2d operator()(Vector2d v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
    Stretch inverse() const { return {yy, -xy, xx}; }
    /// The same in a frame whose x axis is `turn` (of length 1) in this one.
    Stretch in_frame(Vector2d turn) const;
};

/// What each triangle is stretched by: G. Turk, "Texturing Surfaces Using Reaction-Diffusion"
/// (thesis, 1992), section 4.4.1, contracts the places around a cell in the direction of
/// anisotropy.
struct Anisotropy {
    /// Per triangle, of any length; what is normal to the triangle does not count.
    std::vector<Vector3d> direction;
    /// Per triangle, 1 … `largest_ratio`: how many times as long as wide cells are. Diffusion over
    /// them is `ratio` times as fast along the direction as it would be without, and a `ratio`-th
    /// across.
    std::vector<double> ratio;

    static constexpr double largest_ratio = 100;

    /// Of a triangle, brought to 1 … `largest_ratio`.
    double ratio_of(std::uint32_t triangle) const;
    /// In the frame of the triangle. Of no direction within it nothing comes but the surface as it
    /// is.
    Stretch of(const SurfaceMesh& mesh, std::uint32_t triangle) const;
};

}  // namespace cascade
