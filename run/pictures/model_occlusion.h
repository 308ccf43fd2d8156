// The visible part of the sky from each cell of a model raised by heights.
#pragma once

#include "core/parallel.h"
#include "surface/cell_filter.h"

#include <span>
#include <vector>

namespace cascade {

/// For each cell the part, 0 … 1, of 64 rays from the raised surface that leave the model. Rays are
/// as dense as the light of a uniform sky on ground level with the smooth surface, as in
/// height_occlusion(). Heights are in the unit of the mesh. Non-finite ones count as 0. The same on
/// any number of threads. Throws std::bad_alloc.
std::vector<float> model_occlusion(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                   const CellFilter& filter, std::span<const float> heights,
                                   Team& team);

}  // namespace cascade
