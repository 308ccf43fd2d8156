// Degenerate triangles, whose corners are collinear.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

struct FlatTriangles {
    std::size_t merged = 0;     ///< Number of triangles merged with a neighbour.
    std::size_t left_out = 0;   ///< Number of triangles removed at a boundary.
    std::size_t remaining = 0;  ///< Number of triangles that could not be repaired.
};

/// Repairs triangles that are at least 10¹⁰ times as long as high. Flips their longest edges, which
/// leaves two triangles whose area is not 0. Does not flip an edge if the new edge would join
/// points that already share an edge. Fails as half_edges() does.
Result<FlatTriangles> remove_flat_triangles(SurfaceMesh& mesh);

}  // namespace cascade
