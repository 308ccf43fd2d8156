// Triangles whose corners lie on a line.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

struct FlatTriangles {
    std::size_t merged = 0;     ///< Became one with a neighbour.
    std::size_t left_out = 0;   ///< At a boundary: they were taken away.
    std::size_t remaining = 0;  ///< That could not be helped.
};

/// A triangle has no area here if it is 10¹⁰ times as long as high. Its longest edge is flipped,
/// which leaves two triangles with an area each, unless two points would get a second edge. Fails
/// as half_edges() does.
Result<FlatTriangles> remove_flat_triangles(SurfaceMesh& mesh);

}  // namespace cascade
