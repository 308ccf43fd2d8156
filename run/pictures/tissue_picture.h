// Pictures of cells that crawl: things in space, and what they stand on.
#pragma once

#include "mesh/instances.h"
#include "render/draw.h"
#include "run/domain/model_cells.h"
#include "run/pictures/drawn_cells.h"

#include <span>

namespace cascade {

class ModelDrawer;

/// Draws the cells with their colours (sRGB, in the order of numbers) on their model, on their
/// body, over their plane or, in a box, alone. `model` is null without one. A coat of a model is
/// drawn by `drawer`. Throws std::bad_alloc.
Image draw_cells(const DrawnCells& cells, std::span<const Colour> colours, const ModelCells* model,
                 ModelDrawer* drawer, const DrawOptions& options);

// Without a model everything is laid flat, with the plane's normal upwards: y of scripts, which
// points downwards in pictures, comes towards the viewer. That swaps left and right.

/// The places are mirrored; things that stand there keep their own left and right.
void lay_flat(Instances& copies);
void lay_flat(TriangleMesh& mesh);

}  // namespace cascade
