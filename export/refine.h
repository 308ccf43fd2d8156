// A finer mesh of the same shape, for files that have colours at points only: a pattern is no finer
// than the points that show it.
#pragma once

#include "mesh/flat.h"

#include <cstddef>
#include <vector>

namespace cascade {

struct RefinedMesh {
    SurfaceMesh mesh;
    std::vector<SurfacePlace>
        places;  ///< Where each point of it lies in the mesh it was made from.
};

/// Halves edges longer than `longest_edge`, which is above 0, together with the triangles beside
/// them, until none is left or the mesh would have more than `most_triangles`. Points of the mesh
/// stay and come first; texture coordinates and attributes of new ones lie between theirs. Throws
/// std::bad_alloc.
RefinedMesh refined(const SurfaceMesh& mesh, double longest_edge, std::size_t most_triangles);

}  // namespace cascade
