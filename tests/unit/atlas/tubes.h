// Parts of cylinders, which can be unrolled into the plane without distortion.
#pragma once

#include "mesh/edge_pairs.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace cascade::test {

/// A piece of the unit cylinder around the z axis, made of `columns` × `rows` rectangles. It goes
/// around by the fraction `turn` of a full turn, and is closed for 1.
inline SurfaceMesh tube(double turn, double height, std::uint32_t columns, std::uint32_t rows) {
    const std::uint32_t around = turn < 1 ? columns + 1 : columns;
    std::vector<Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * turn * i / columns;
            points.push_back({std::cos(angle), std::sin(angle), height * j / rows});
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around;
            triangles.push_back({a, b, a + around});
            triangles.push_back({b, b + around, a + around});
        }
    }
    return mesh_of(points, triangles);
}

}  // namespace cascade::test
