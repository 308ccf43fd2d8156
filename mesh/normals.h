// Smooth normals.
#pragma once

#include "mesh/flat.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// The unit normal at each point: the direction of the sum of the normals of its triangles,
/// weighted by area. It is (0, 0, 1) if the normals cancel out.
std::vector<Vector3d> point_normals(const SurfaceMesh& mesh);

/// The unit normal at any position, interpolated between the normals at the triangle's corners. If
/// these normals cancel out, it is the triangle's normal.
Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place);

/// Normals with creases. The triangles around a point form groups. Adjacent triangles are in one
/// group if the surface bends by at most 60° at their common edge. The point has one normal per
/// group.
struct CornerNormals {
    /// Computed as in point_normals(), but each only from the triangles of one group.
    std::vector<Vector3d> normals;
    /// The point of each normal, in ascending order.
    std::vector<std::uint32_t> points;
    std::vector<std::array<std::uint32_t, 3>> numbers;  ///< The normal of each corner.

    /// The unit normal at any position, interpolated between the triangle's corners. If the
    /// corners' normals cancel out, it is the triangle's normal.
    Vector3d at(const SurfaceMesh& mesh, const SurfacePlace& place) const;
};
CornerNormals corner_normals(const SurfaceMesh& mesh);

}  // namespace cascade
