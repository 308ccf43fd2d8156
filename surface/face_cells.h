// The faces of a model as cells.
#pragma once

#include "surface/surface_cells.h"

namespace cascade {

/// One cell for each face of the model, in the order of their first triangles. A face is a
/// triangle, or the triangles of one polygon (SurfaceMesh::faces). The edges between faces are
/// Voronoi edges: R. Mills, D. Newman, S. Smith and Q. Y. Zhang, "Morphogenesis and Skin Pattern
/// Generation for 3D Models" (University of Southampton, 2005), give each triangle of a model three
/// neighbours and weight diffusion by the edges' lengths.
///
/// The place of a triangle is its circumcentre, that of another polygon its centroid; the distance
/// across an edge is the sum of the two places' distances from its line. Without obtuse angles the
/// cells therefore form a Voronoi diagram and diffusion is consistent (R. Eymard, T. Gallouët and
/// R. Herbin, "Finite Volume Methods", 2000, section 9). The circumcentre of an obtuse triangle is
/// outside of it, and that of a right-angled one is on an edge; such a centre is moved inside until
/// every corner has a weight of 1/9, which bounds the weights. Diffusion then has an error, of up
/// to a tenth on squares cut in two.
SurfaceCells face_cells(const SurfaceMesh& mesh);

/// For each triangle, the index of its face's cell.
std::vector<std::uint32_t> cells_of_triangles(const SurfaceMesh& mesh);

}  // namespace cascade
