// Refinement of a mesh for files with vertex colours only.
#pragma once

#include "mesh/flat.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cascade {

struct RefinedMesh {
    SurfaceMesh mesh;
    std::vector<SurfacePlace> places;  ///< The place of each point in the original mesh.
};

/// Halves edges longer than `longest_edge` (positive), splitting the triangles at them, until none
/// is left or the mesh would exceed `most_triangles`. The mesh's points come first, unchanged;
/// texture coordinates and attributes of new points are interpolated. Throws std::bad_alloc.
RefinedMesh refined(const SurfaceMesh& mesh, double longest_edge, std::size_t most_triangles);

/// Moves each point along its normal by its height, in lengths of the mesh; one each. Heights that
/// are not finite count as 0.
void displace(SurfaceMesh& mesh, std::span<const Vector3d> normals, std::span<const float> heights);

}  // namespace cascade
