// Models with triangles as fine as their cells.
#pragma once

#include "core/parallel.h"
#include "export/refine.h"
#include "surface/cell_filter.h"
#include "surface/surface_cells.h"

#include <span>

namespace cascade {

/// Refines the mesh so far that the colours of cells at its points show their pattern.
RefinedMesh refined_for_colours(const SurfaceMesh& mesh, const SurfaceCells& cells);

/// The refined mesh `fine` of `mesh`, raised along the smooth normals of `mesh` by the filtered
/// heights of its cells, one each, in lengths of the mesh. Positions refer to `mesh`. Non-finite
/// heights count as 0 near a point. The same on any number of threads. Throws std::bad_alloc.
RefinedMesh raised_model(RefinedMesh fine, const SurfaceMesh& mesh, const CellFilter& filter,
                         std::span<const float> heights, Team& team);

}  // namespace cascade
