// Pictures of crawling cells: things in space, and the surface below them.
#pragma once

#include "mesh/instances.h"
#include "render/draw.h"
#include "run/domain/model_cells.h"
#include "run/pictures/drawn_cells.h"

#include <span>

namespace cascade {

class ModelDrawer;

/// Draws the cells with their colours (sRGB, in the order of numbers) on their model, on their
/// body, over their plane or, in a box, alone. `model` is null without one. `drawer` draws a coat
/// of a model. Throws std::bad_alloc.
Image draw_cells(const DrawnCells& cells, std::span<const Colour> colours, const ModelCells* model,
                 ModelDrawer* drawer, const DrawOptions& options);

// Lays everything flat without a model, with the plane's normal upwards: y of scripts, which points
// downwards in pictures, comes towards the viewer. That swaps left and right.

/// Positions are mirrored. Things at these positions keep their own left and right.
void lay_flat(Instances& copies);
void lay_flat(TriangleMesh& mesh);

}  // namespace cascade
