// The frame of the tube is carried along the curve by the double reflection of W. Wang, B. Jüttler,
// D. Zheng and Y. Liu, "Computation of Rotation Minimizing Frames", ACM Transactions on Graphics
// 27(1), 2008.
#include "mesh/knot.h"

#include "mesh/lattice_mesh.h"
#include "mesh/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace cascade {

namespace {

constexpr double length_of_curve = 28.826;

Vector3d curve(double phi) {
    return {std::sin(phi) + 2 * std::sin(2 * phi), std::cos(phi) - 2 * std::cos(2 * phi),
            -std::sin(3 * phi)};
}

Vector3d tangent(double phi) {
    const Vector3d along{std::cos(phi) + 4 * std::cos(2 * phi),
                         4 * std::sin(2 * phi) - std::sin(phi), -3 * std::cos(3 * phi)};
    return along * (1 / length(along));
}

Vector3d reflected(Vector3d v, Vector3d across) {
    return v - across * (2 * dot(across, v) / dot(across, across));
}

/// A unit normal of the curve at n places, and at the first one again after a turn.
std::vector<Vector3d> normals_along(std::uint32_t n) {
    std::vector<Vector3d> normals{cross(tangent(0), Vector3d{0, 0, 1})};
    normals[0] = normals[0] * (1 / length(normals[0]));
    for (std::uint32_t i = 0; i < n; ++i) {
        const double here = tau * i / n, next = tau * (i + 1) / n;
        const Vector3d step = curve(next) - curve(here);
        const Vector3d along = reflected(tangent(here), step);
        normals.push_back(reflected(reflected(normals.back(), step), tangent(next) - along));
    }
    return normals;
}

}  // namespace

Result<SurfaceMesh> knot_mesh(double radius, double edge) {
    if (!(radius > 0 && radius < most_knot_radius)) {
        return failure(fmt::format("a tube of radius {} cannot be tied to the knot", radius),
                       fmt::format("the radius is above 0 and below {}", most_knot_radius));
    }
    const double columns = std::round(length_of_curve / edge);
    const double rows = std::max(3.0, std::round(tau * radius / edge));
    if (!(edge > 0 && 2 * columns * rows <= most_shape_triangles)) {
        return failure(fmt::format("edges of length {} make too many triangles of the knot", edge),
                       "choose longer edges");
    }
    const auto n = static_cast<std::uint32_t>(std::max(24.0, columns));
    const std::vector<Vector3d> normals = normals_along(n);
    // The angle by which the last normal misses the first one.
    const Vector3d across = cross(tangent(0), normals[0]);
    const double missing = std::atan2(dot(normals[n], across), dot(normals[n], normals[0]));
    return ring_lattice(n, static_cast<std::uint32_t>(rows), [&](std::uint32_t i, std::uint32_t j) {
        const double phi = tau * i / n, angle = tau * j / rows + missing * i / n;
        const Vector3d side = cross(normals[i], tangent(phi));
        return curve(phi) + (normals[i] * std::cos(angle) + side * std::sin(angle)) * radius;
    });
}

}  // namespace cascade
