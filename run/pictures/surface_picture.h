// Draws a texture on a surface given by a function.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/draw.h"
#include "run/pictures/surface_finish.h"
#include "surface/parameter_surface.h"

namespace cascade {

/// Draws `surface` with `texture`, which has a pixel for each cell, and with the material of the
/// cells. Colours are interpolated linearly between the centres of cells, also across joined sides.
/// Near a side that is not joined, the colour of the outermost cell continues unchanged. Throws
/// std::bad_alloc.
Image draw_on_surface(const SurfaceFunction& surface, const Image& texture,
                      const GridMaterial& material, const DrawOptions& options, Team& team);

}  // namespace cascade
