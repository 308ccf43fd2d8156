// The points of a model as cells.
#pragma once

#include "surface/surface_cells.h"

namespace cascade {

/// A cell around each point, with the number of the point: its area is the mixed Voronoi area, the
/// weight of the Voronoi edge to a point at the other end of an edge is (cot α + cot β) / 2 of the
/// angles that face the edge (M. Meyer, M. Desbrun, P. Schröder and A. Barr, "Discrete
/// Differential-Geometry Operators for Triangulated 2-Manifolds", 2003, sections 3.3 and 3.5):
/// linear finite elements with lumped masses.
///
/// Weights below zero, which obtuse angles give and which would let diffusion run uphill, are
/// avoided: areas and weights are those of the intrinsic Delaunay triangulation of the same surface
/// (mesh/intrinsic_delaunay.h), which changes nothing where no two angles have more than 180°.
/// At a boundary an angle alone may be obtuse: such an edge has no Voronoi edge. The areas sum to
/// that of the surface.
SurfaceCells vertex_cells(const SurfaceMesh& mesh);

}  // namespace cascade
