// A texture laid on the surface that it has grown on, and drawn.
#pragma once

#include "core/parallel.h"
#include "picture/image.h"
#include "render/draw.h"
#include "surface/parameter_surface.h"

namespace cascade {

/// Draws `surface` with `texture`, a pixel for each cell, on it. Between the centres of cells
/// colours are linear; across joined sides they go on, at others the last cell's stays.
/// Throws std::bad_alloc.
Image draw_on_surface(const SurfaceFunction& surface, const Image& texture, bool periodic_x,
                      bool periodic_y, const DrawOptions& options, Team& team);

}  // namespace cascade
