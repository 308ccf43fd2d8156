// Anisotropic surfaces, whose metric differs along and across a direction.
#pragma once

#include "mesh/flat.h"

#include <vector>

namespace cascade {

/// A symmetric matrix of determinant 1. It maps vectors of a plane to vectors with the length of
/// the anisotropic metric, and preserves areas.
struct Stretch {
    double xx = 1, xy = 0, yy = 1;

    /// Scales by 1/√ratio along a direction of the plane and by √ratio across it: an ellipse
    /// `ratio` times as long as wide becomes a circle.
    static Stretch along(Vector2d direction, double ratio);

    Vector2d operator()(Vector2d v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
    Stretch inverse() const { return {yy, -xy, xx}; }
    /// The length, at least 1, of the longest vector whose length in the metric is 1.
    double longest() const;
    /// The same stretch in a frame whose x axis is the unit vector `turn` in this one.
    Stretch in_frame(Vector2d turn) const;
};

/// The stretch of each triangle. G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis,
/// 1992), section 4.4.1, contracts the points around a cell in the direction of anisotropy.
struct Anisotropy {
    /// Per triangle, of any length. The component normal to the triangle is ignored.
    std::vector<Vector3d> direction;
    /// Per triangle, 1 … `largest_ratio`: the length of cells over their width. Relative to no
    /// anisotropy, diffusion is `ratio` times as fast along the direction and 1/ratio times across.
    std::vector<double> ratio;

    static constexpr double largest_ratio = 100;

    /// The ratio of a triangle, clamped to 1 … `largest_ratio`.
    double ratio_of(std::uint32_t triangle) const;
    /// The stretch in the triangle's frame. The identity if the direction vanishes in its plane.
    Stretch of(const SurfaceMesh& mesh, std::uint32_t triangle) const;
};

}  // namespace cascade
