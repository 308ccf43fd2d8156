// Measures of meshes, such as angles and lengths of edges, and a check that a mesh is closed.
#pragma once

#include "mesh/surface_mesh.h"
#include "unit/mesh/soups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::test {

/// Expects a consistent surface without boundary.
inline void expect_closed(const SurfaceMesh& mesh) {
    expect_manifold(mesh);
    EXPECT_EQ(facts_of(mesh).boundary_edges, 0u);
}

/// The angle at corner k of a triangle, in radians.
inline double angle_at(const SurfaceMesh& mesh, std::size_t triangle, std::size_t k) {
    const Vector3d p = mesh.corner(triangle, k);
    const Vector3d a = mesh.corner(triangle, (k + 1) % 3) - p;
    const Vector3d b = mesh.corner(triangle, (k + 2) % 3) - p;
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The smallest angle of all triangles, in degrees.
inline double smallest_angle(const SurfaceMesh& mesh) {
    double smallest = std::numbers::pi;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) smallest = std::min(smallest, angle_at(mesh, t, k));
    }
    return smallest * 180 / std::numbers::pi;
}

inline double mean_edge(const SurfaceMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            sum += length(mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k));
        }
    }
    return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

/// 2π minus the sum of angles at each point: the integral of the Gaussian curvature around the
/// point.
inline std::vector<double> angle_defects(const SurfaceMesh& mesh) {
    std::vector<double> defects(mesh.points.size(), 2 * std::numbers::pi);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) defects[mesh.triangles[t][k]] -= angle_at(mesh, t, k);
    }
    return defects;
}

}  // namespace cascade::test
