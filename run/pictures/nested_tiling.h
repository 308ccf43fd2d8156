// A model whose triangles lie between its cells, and coarser ones between fewer and fewer of them.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "export/levels.h"
#include "run/pictures/model_picture.h"

#include <span>
#include <vector>

namespace cascade {

/// Levels of detail by retiling at several densities (G. Turk, "Re-Tiling Polygonal Surfaces",
/// SIGGRAPH 1992, section 5): the points of level 0 are the cells, and each next level has a
/// quarter of the points, spread uniformly (nested_order). Colours, channels and heights are
/// blurred to the distance of the level's points, colours in linear light (G. Turk, "Texturing
/// Surfaces Using Reaction-Diffusion", thesis, 1992, section 5.4). Up to `count` levels, fewer
/// where the topology needs the remaining points. Fails as retile() does. Throws std::bad_alloc.
Result<std::vector<ModelLevel>> nested_tiling(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                              const ModelLook& look,
                                              std::span<const Channel> channels, int count,
                                              Team& team);

}  // namespace cascade
