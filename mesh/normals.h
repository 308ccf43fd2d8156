// Smooth normals.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// The unit normal at each point: the direction of the sum of its triangles' normals, weighted by
/// area. (0, 0, 1) if they cancel out.
std::vector<Vector3d> point_normals(const SurfaceMesh& mesh);

/// The unit normal at any position: the interpolated normals of the triangle's corners, or the
/// triangle's normal if they cancel out.
Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place);

/// Normals with creases: a point has one for each group of its triangles that are connected over
/// edges with a dihedral bend of at most 60°.
struct CornerNormals {
    std::vector<Vector3d> normals;      ///< Computed as in point_normals(), each over its group.
    std::vector<std::uint32_t> points;  ///< The point of each normal, ascending.
    std::vector<std::array<std::uint32_t, 3>> numbers;  ///< Normal of each corner.

    /// The interpolated unit normal of the corners, or the triangle's normal if they cancel out.
    Vector3d at(const SurfaceMesh& mesh, const SurfacePlace& place) const;
};
CornerNormals corner_normals(const SurfaceMesh& mesh);

}  // namespace cascade
