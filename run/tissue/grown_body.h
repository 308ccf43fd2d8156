// The body grown by a stage of fields in a volume, as a surface: cells crawl on it, pictures show
// it.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "core/side.h"
#include "mesh/surface_mesh.h"

#include <atomic>

namespace cascade {

/// The closed surface around the cells of a grid with slices whose values are above 0, in script
/// lengths: the level set of the values interpolated linearly between the centres of cells, and the
/// sides of the box where the body reaches them. Its triangles have edges of about `edge` cells.
/// Thinner parts may be lost (see implicit_surface()). Fails if no value is above 0, if one is not
/// finite, if the grid is too large, and when `cancel` becomes true. Throws std::bad_alloc.
Result<SurfaceMesh> grown_body(const Field& values, Boundaries boundary,
                               const std::atomic<bool>& cancel, double edge = 1);

}  // namespace cascade
