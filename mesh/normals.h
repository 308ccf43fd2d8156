// Smooth normals: directions at right angles to the surface that its triangles only suggest.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// At each point the sum of the normals of its triangles, each as long as twice the triangle's
/// area, scaled to length 1. (0, 0, 1) where they cancel out.
std::vector<Vector3d> point_normals(const SurfaceMesh& mesh);

/// The same anywhere: the normals of the triangle's corners, weighted and scaled to length 1. That
/// of the triangle where they cancel out.
Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place);

/// Normals that are smooth where the surface is meant to be round: a point has one for each group
/// of its triangles that are connected over edges at which they meet at no more than 60°.
struct CornerNormals {
    std::vector<Vector3d> normals;      ///< Found as in point_normals(), each over its group.
    std::vector<std::uint32_t> points;  ///< Of each normal, ascending.
    std::vector<std::array<std::uint32_t, 3>> numbers;  ///< Of the normals at a triangle's corners.

    /// Those at the corners weighted, of length 1; that of the triangle where they cancel out.
    Vector3d at(const SurfaceMesh& mesh, const SurfacePlace& place) const;
};
CornerNormals corner_normals(const SurfaceMesh& mesh);

}  // namespace cascade
