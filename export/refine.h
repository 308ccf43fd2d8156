// Refinement of a mesh for files with vertex colours only.
#pragma once

#include "mesh/flat.h"

#include <cstddef>
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

}  // namespace cascade
