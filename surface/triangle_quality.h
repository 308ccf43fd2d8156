// The quality of a triangle relative to the normals of a surface.
#pragma once

#include "core/vector3.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

struct TriangleQuality {
    double least_sine = 0;  ///< The sine of the smallest angle; 0 if the corners are collinear.
    /// The least cosine between the triangle's normal and a corner's normal.
    double least_cosine = 0;
    /// The cosine between the triangle's normal and the mean of its corners' normals. Negative if
    /// the triangle is upside down.
    double mean_cosine = 0;

    /// The score by which flips choose between triangles: the sine of the smallest angle, reduced
    /// if the triangle deviates from the surface.
    double score() const { return least_sine * std::clamp(least_cosine / 0.9, 0.01, 1.0); }
};

/// `normals` are the unit normals of the surface at the corners, or 0 where the surface has none.
inline TriangleQuality quality_of(const std::array<Vector3d, 3>& corners,
                                  const std::array<Vector3d, 3>& normals) {
    const Vector3d ab = corners[1] - corners[0], bc = corners[2] - corners[1];
    const Vector3d ca = corners[0] - corners[2];
    const Vector3d normal = cross(ab, -ca);
    const double double_area = length(normal);
    const double c = length(ab), a = length(bc), b = length(ca);
    const Vector3d direction = unit(normal);
    TriangleQuality quality;
    if (double_area > 0) quality.least_sine = double_area / std::max({a * b, b * c, c * a});
    quality.least_cosine = std::min(
        {dot(direction, normals[0]), dot(direction, normals[1]), dot(direction, normals[2])});
    quality.mean_cosine = dot(direction, unit(normals[0] + normals[1] + normals[2]));
    return quality;
}

}  // namespace cascade
