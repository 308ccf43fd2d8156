// Draws crawling cells as objects in space, and the surface below them.
#pragma once

#include "mesh/instances.h"
#include "render/draw.h"
#include "run/domain/model_cells.h"
#include "run/pictures/drawn_cells.h"

#include <span>

namespace cascade {

class ModelDrawer;

/// Draws the cells on their model, on their body, over their plane, or in a box without any
/// surface. `colours` are in sRGB, in the order of the cells' numbers. `model` is null if there is
/// no model. `drawer` draws the coat of a model. Throws std::bad_alloc.
Image draw_cells(const DrawnCells& cells, std::span<const Colour> colours, const ModelCells* model,
                 ModelDrawer* drawer, const DrawOptions& options);

// If there is no model, lay_flat() turns everything so that the plane's normal points upwards in
// pictures. The y axis of scripts, which points downwards in pictures of planes, points towards the
// viewer after the turn. This swaps left and right.

/// Mirrors the positions of copies, but does not mirror the shape of each copy.
void lay_flat(Instances& copies);
void lay_flat(TriangleMesh& mesh);

}  // namespace cascade
