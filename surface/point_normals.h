// Smooth normals: directions at right angles to the surface as its triangles only suggest it.
#pragma once

#include "surface/flat.h"

#include <vector>

namespace cascade {

/// At each point the sum of the normals of its triangles, each as long as twice the triangle's
/// area, scaled to length 1. (0, 0, 1) where they cancel out.
std::vector<Vector3d> point_normals(const SurfaceMesh& mesh);

/// The same anywhere: the normals of the triangle's corners, weighted and scaled to length 1. That
/// of the triangle where they cancel out.
Vector3d normal_at(const SurfaceMesh& mesh, const std::vector<Vector3d>& normals,
                   const SurfacePlace& place);

}  // namespace cascade
