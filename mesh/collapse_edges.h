// Edges of a closed surface drawn together to points.
#pragma once

#include "mesh/surface_mesh.h"

namespace cascade {

/// The triangles around a point of a closed surface, counterclockwise: calls `visit` with each as the
/// edge of it that leaves the point.
template <typename Visit>
void around_point(const SurfaceMesh& mesh, TriangleEdge leaving, const Visit& visit) {
    TriangleEdge at = leaving;
    do {
        visit(at);
        at = mesh.across[at.triangle][(at.edge + 2) % 3];
    } while (at != leaving);
}

/// One edge of each point that leaves it.
std::vector<TriangleEdge> leaving_edges(const SurfaceMesh& mesh);

/// Draws edges shorter than `shortest` together to their middle, in order of their triangles, where the surface
/// keeps its form: the two ends have no common neighbours but those of the edge's own triangles (the
/// link condition: T. Dey et al., "Topology Preserving Edge Contraction", Publ. Inst. Math. Beograd 66,
/// 1999), no triangle turns by more than 75°, and no edge becomes longer than `longest`. The mesh is
/// closed and has neither texture nor attributes.
void collapse_edges(SurfaceMesh& mesh, double shortest, double longest);

}  // namespace cascade
