// The points of a model as cells.
#pragma once

#include "surface/surface_cells.h"

namespace cascade {

/// One cell around each point, with the point's index. Its area is the mixed Voronoi area. The
/// weight of the Voronoi edge across an edge is (cot α + cot β) / 2, where α and β are the angles
/// opposite that edge (M. Meyer, M. Desbrun, P. Schröder and A. Barr, "Discrete
/// Differential-Geometry Operators for Triangulated 2-Manifolds", 2003, sections 3.3 and 3.5):
/// linear finite elements with lumped masses.
///
/// Obtuse angles could give negative weights, which let diffusion run uphill. So areas and weights
/// are those of the intrinsic Delaunay triangulation of the surface (mesh/intrinsic_delaunay.h),
/// which is the same if no two opposite angles exceed 180° together. A boundary edge opposite an
/// obtuse angle has no Voronoi edge. The areas sum to that of the surface.
SurfaceCells vertex_cells(const SurfaceMesh& mesh);

}  // namespace cascade
