// Cells of surfaces with many more triangles than cells, such as scans.
#pragma once

#include "surface/make_cells.h"

namespace cascade {

/// Whether the mesh has enough triangles per cell for cells_by_copy() to save time.
bool is_fine(const SurfaceMesh& mesh, const CellOptions& options);

/// Makes a coarse copy of the surface with a few triangles per cell. Relaxes positions on the copy,
/// finds their Voronoi regions there, and moves each position to the nearest position on the
/// surface itself. Scales the areas of cells so that they sum to the area of their component on the
/// original surface. Roughness of the surface much finer than cells does not affect the cells.
/// Fails as half_edges() does. Throws std::bad_alloc. The result is the same with any number of
/// threads. It is undefined if `cancel` became true.
Result<SurfaceCells> cells_by_copy(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                   const std::atomic<bool>& cancel);

}  // namespace cascade
