// Draws a texture on the surface where it has grown.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/draw.h"
#include "surface/parameter_surface.h"

namespace cascade {

/// Draws `surface` with `texture`, which has a pixel for each cell. Colours are linear between the
/// centres of cells. They continue across joined sides and are constant beyond the last cell at
/// others. Throws std::bad_alloc.
Image draw_on_surface(const SurfaceFunction& surface, const Image& texture, bool periodic_x,
                      bool periodic_y, const DrawOptions& options, Team& team);

}  // namespace cascade
