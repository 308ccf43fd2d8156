// Computes how much of the sky is visible from each cell of a model that is raised by heights.
#pragma once

#include "core/parallel.h"
#include "surface/cell_filter.h"

#include <span>
#include <vector>

namespace cascade {

/// Returns, for each cell, which fraction (0 … 1) of 64 rays from the raised surface leave the
/// model. The directions of the rays are distributed like the light of a uniform sky over the
/// tangent plane of the smooth surface (see height_occlusion()). Heights are in lengths of the
/// mesh. A height that is not finite counts as 0. The result does not depend on the number of
/// threads. Throws std::bad_alloc.
std::vector<float> model_occlusion(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                   const CellFilter& filter, std::span<const float> heights,
                                   Team& team);

}  // namespace cascade
