// Retiles a model: replaces its triangles by triangles between its cells. Coarser levels use fewer
// of the cells.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "export/levels.h"
#include "run/pictures/model_picture.h"

#include <span>
#include <vector>

namespace cascade {

/// Makes levels of detail by retiling at several densities (G. Turk, "Re-Tiling Polygonal
/// Surfaces", SIGGRAPH 1992, section 5). The points of level 0 are the cells. Each further level
/// has a quarter of the points of the level before, spread uniformly (see nested_order()). Colours
/// (as linear light), channels and heights are blurred to the distance between the level's points
/// (G. Turk, "Texturing Surfaces Using Reaction-Diffusion", thesis, 1992, section 5.4). Makes at
/// most `count` levels. Stops earlier if the topology of the surface needs more than half of the
/// triangles of the level before. Fails in the same cases as retile(). Throws std::bad_alloc.
Result<std::vector<ModelLevel>> nested_tiling(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                              const ModelLook& look,
                                              std::span<const Channel> channels, int count,
                                              Team& team);

}  // namespace cascade
