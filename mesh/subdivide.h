// Makes smooth surfaces from coarse triangles, by OpenMesh's subdivider.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// The largest number of triangles that subdivide() makes.
inline constexpr std::size_t most_subdivided = std::size_t{1} << 24;

/// Cuts each triangle into four, `times` times over. The points approach a smooth surface (C. Loop,
/// "Smooth Subdivision Surfaces Based on Triangles", master's thesis, University of Utah, 1987).
/// Boundaries become smooth curves, and creases are rounded. The points of `mesh` keep their
/// indices, and new points follow. Attributes and texture coordinates of new points are
/// interpolated at the middles of edges.
///
/// Fails if there would be more than `most_subdivided` triangles, and as half_edges() does. Throws
/// std::bad_alloc.
Result<SurfaceMesh> subdivide(const SurfaceMesh& mesh, int times);

}  // namespace cascade
