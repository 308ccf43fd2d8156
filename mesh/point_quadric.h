// The error of a point that has taken the place of others, in its place and in its attributes.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstddef>
#include <span>

namespace cascade {

/// A sum over triangles of their areas times the squared distance of a point from their planes,
/// plus the squared differences of its attributes from the linear functions that attributes are
/// on these triangles (H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance
/// Attributes", IEEE Visualization 1999).
class PointQuadric {
public:
    static constexpr std::size_t most_attributes = 3;
    using Attributes = std::array<double, most_attributes>;

    /// Adds a plane through `at`, with a unit normal.
    void add_plane(double weight, Vector3d at, Vector3d normal);
    /// Adds a triangle that is not degenerate; `values` are the attributes of its corners.
    void add_triangle(const std::array<Vector3d, 3>& corners,
                      const std::array<Attributes, 3>& values, std::size_t attributes);
    PointQuadric& operator+=(const PointQuadric& other);

    /// Of a point here. Rounding may make it a little less than 0.
    double error(Vector3d point, const Attributes& values, std::size_t attributes) const;
    /// Of the triangles added.
    double area() const { return area_; }

private:
    /// Adds weight (slope · p + constant)².
    void add_square(double weight, Vector3d slope, double constant);

    std::array<double, 6> squares_{};  ///< xx, xy, xz, yy, yz, zz.
    Vector3d linear_;
    double constant_ = 0, area_ = 0;
    std::array<Vector3d, most_attributes> slopes_{};  ///< Σ area · gradient.
    Attributes offsets_{};
};

}  // namespace cascade
