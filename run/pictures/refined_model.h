// Refines models so that their triangles are as fine as their cells.
#pragma once

#include "core/parallel.h"
#include "export/refine.h"
#include "surface/cell_filter.h"
#include "surface/surface_cells.h"

#include <span>

namespace cascade {

/// Refines the mesh until colours at its points can show the pattern of the cells.
RefinedMesh refined_for_colours(const SurfaceMesh& mesh, const SurfaceCells& cells);

/// Raises the refined mesh `fine` along the smooth normals of `mesh`. `heights` has a height for
/// each cell, in lengths of the mesh. These heights are filtered before use. The positions in
/// `fine` refer to `mesh`. At points near a cell whose height is not finite, this height counts as
/// 0. The result does not depend on the number of threads. Throws std::bad_alloc.
RefinedMesh raised_model(RefinedMesh fine, const SurfaceMesh& mesh, const CellFilter& filter,
                         std::span<const float> heights, Team& team);

}  // namespace cascade
