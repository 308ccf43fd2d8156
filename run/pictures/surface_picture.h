// Draws a texture on a surface given by a function.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/draw.h"
#include "surface/parameter_surface.h"

namespace cascade {

/// Draws `surface` with `texture`, which has a pixel for each cell. Colours are interpolated
/// linearly between the centres of cells, also across joined sides. Between the outermost centres
/// and any other side they are constant. Throws std::bad_alloc.
Image draw_on_surface(const SurfaceFunction& surface, const Image& texture, bool periodic_x,
                      bool periodic_y, const DrawOptions& options, Team& team);

}  // namespace cascade
