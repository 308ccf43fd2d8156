// Makes the surface of a body that a stage of fields has grown in a volume. Cells crawl on this
// surface, and pictures show it.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/side.h"
#include "mesh/surface_mesh.h"

#include <atomic>

namespace cascade {

/// Makes the closed surface around the cells whose values are above 0, in a grid with slices.
/// Lengths are in the script's unit. The surface is the level set of the values, interpolated
/// linearly between the centres of cells. Where the body reaches a side of the box, the surface is
/// closed along that side. The edges of the surface's triangles are about `edge` cells long.
/// Thinner parts of the body may be lost (see implicit_surface()). Fails if no value is above 0, if
/// a value is not finite, if the grid is too large, or if `cancel` becomes true. Throws
/// std::bad_alloc.
Result<SurfaceMesh> grown_body(const Field& values, Boundaries boundary,
                               const std::atomic<bool>& cancel, double edge = 1);

}  // namespace cascade
