// The faces of a model as cells.
#pragma once

#include "surface/surface_cells.h"

namespace cascade {

/// A cell for each face of the model: a triangle, or the triangles of one polygon
/// (SurfaceMesh::faces), in order of their first triangles. The edges between faces are their
/// Voronoi edges: R. Mills, D. Newman, S. Smith and Q. Y. Zhang, "Morphogenesis and Skin Pattern
/// Generation for 3D Models" (University of Southampton, 2005), give each triangle of a model three
/// neighbours and weight diffusion by the edges' lengths.
///
/// The place of a triangle is its circumcentre, that of another polygon its centroid; the distance
/// across an edge is the sum of the two places' distances from its line. Where no angle is obtuse
/// cells are thereby those of a Voronoi diagram and diffusion is consistent (R. Eymard, T. Gallouët
/// and R. Herbin, "Finite Volume Methods", 2000, section 9). The circumcentre of an obtuse triangle
/// lies outside and that of a right-angled one on an edge: it is brought inside, until every corner
/// has a weight of a ninth, so that weights are bounded. Diffusion is then off, by up to a tenth on
/// squares cut in two: as good as a model's faces are.
SurfaceCells face_cells(const SurfaceMesh& mesh);

/// Of each triangle: the number of its face's cell.
std::vector<std::uint32_t> cells_of_triangles(const SurfaceMesh& mesh);

}  // namespace cascade
