// Cells of surfaces with many more triangles than cells, such as scans.
#pragma once

#include "surface/make_cells.h"

namespace cascade {

/// Whether triangles outnumber cells so far that cells_by_copy() pays off.
bool is_fine(const SurfaceMesh& mesh, const CellOptions& options);

/// Relaxes positions on a coarse copy of the surface with a few triangles per cell, finds their
/// Voronoi regions there, and moves each to the nearest position on the surface itself. Scales the
/// areas of cells to the original area of their component. Roughness much finer than cells does not
/// affect them. Fails as half_edges() does. Throws std::bad_alloc. The same on any number of
/// threads. Undefined if `cancel` became true.
Result<SurfaceCells> cells_by_copy(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                   const std::atomic<bool>& cancel);

}  // namespace cascade
