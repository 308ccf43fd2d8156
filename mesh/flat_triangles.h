// Degenerate triangles, whose corners are collinear.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

struct FlatTriangles {
    std::size_t merged = 0;     ///< Merged with a neighbour.
    std::size_t left_out = 0;   ///< Removed at a boundary.
    std::size_t remaining = 0;  ///< Could not be repaired.
};

/// Flips the longest edges of triangles 10¹⁰ times as long as high, which leaves two triangles with
/// an area, unless two points would get a second edge. Fails as half_edges() does.
Result<FlatTriangles> remove_flat_triangles(SurfaceMesh& mesh);

}  // namespace cascade
