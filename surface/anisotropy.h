// Anisotropic surfaces: the metric along a direction differs from the metric across it.
#pragma once

#include "mesh/flat.h"

#include <vector>

namespace cascade {

/// A symmetric matrix of determinant 1 that describes an anisotropic metric in a plane. To find the
/// length of a vector in this metric, multiply the vector by the matrix and take the ordinary
/// length. Areas are the same in both metrics.
struct Stretch {
    double xx = 1, xy = 0, yy = 1;

    /// Divides lengths along a direction of the plane by √ratio and multiplies lengths across it by
    /// √ratio. An ellipse `ratio` times as long as wide thus becomes a circle.
    static Stretch along(Vector2d direction, double ratio);

    Vector2d operator()(Vector2d v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
    Stretch inverse() const { return {yy, -xy, xx}; }
    /// The length, at least 1, of the longest vector whose length in the metric is 1.
    double longest() const;
    /// The same stretch in another frame. The unit vector `turn` is the other frame's x axis in
    /// this frame.
    Stretch in_frame(Vector2d turn) const;
};

/// The direction and ratio of stretching in each triangle. G. Turk, "Texturing Surfaces Using
/// Reaction-Diffusion" (thesis, 1992), section 4.4.1, contracts the points around a cell in the
/// direction of anisotropy.
struct Anisotropy {
    /// A vector of any length per triangle. Its component normal to the triangle is ignored.
    std::vector<Vector3d> direction;
    /// The ratio in each triangle, 1 … `largest_ratio`: the length of cells divided by their width.
    /// Compared with an isotropic surface, diffusion is `ratio` times as fast along the direction
    /// and 1/ratio times as fast across it.
    std::vector<double> ratio;

    static constexpr double largest_ratio = 100;

    /// The ratio of a triangle, clamped to 1 … `largest_ratio`.
    double ratio_of(std::uint32_t triangle) const;
    /// The stretch in the triangle's frame. The identity if the direction is perpendicular to the
    /// triangle.
    Stretch of(const SurfaceMesh& mesh, std::uint32_t triangle) const;
};

}  // namespace cascade
