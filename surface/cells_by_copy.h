// Cells of surfaces with many more triangles than cells, such as scans.
#pragma once

#include "surface/make_cells.h"

namespace cascade {

/// Whether triangles outnumber cells so far that cells_by_copy() is to make them.
bool is_fine(const SurfaceMesh& mesh, const CellOptions& options);

/// Relaxes places on a coarse copy of the surface with a few triangles per cell, finds their
/// Voronoi regions there, and moves each place to the nearest one on the surface itself. The area
/// of each component, shared by its cells, is that of the surface. Roughness that is much finer
/// than cells does not affect them. Fails as half_edges() does. Throws std::bad_alloc. The same on
/// any number of threads. Undefined if `cancel` became true.
Result<SurfaceCells> cells_by_copy(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                   const std::atomic<bool>& cancel);

}  // namespace cascade
