// Exchanging the edge between two triangles for the other diagonal of the quadrilateral they make.
#pragma once

#include "mesh/surface_mesh.h"

namespace cascade {

/// Exchanges the edge for the line between the two corners that face it. The edge must have a
/// triangle on either side. Both triangles keep their numbers.
void exchange_edge(SurfaceMesh& mesh, TriangleEdge edge);

struct ExchangedEdges {
    std::size_t exchanged = 0;  ///< Triangles without area that were merged with a neighbour.
    std::size_t left_out = 0;   ///< At a boundary: they were taken away.
    std::size_t remaining = 0;  ///< That could not be helped.
};

/// A triangle has no area here if it is 10¹⁰ times as long as high. Its corners lie on a line; its
/// longest edge is exchanged, which leaves two triangles with an area each.
ExchangedEdges remove_flat_triangles(SurfaceMesh& mesh);

}  // namespace cascade
