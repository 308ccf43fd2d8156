// Separation of fans of triangles that only share a point.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Renumbers the corners of the triangles so that triangles share a point only if they are
/// connected over edges at it. Leaves points in order and drops unused ones. Returns the old index
/// of each new point. The caller updates `points` and `attributes`.
std::vector<std::uint32_t> separate_fans(SurfaceMesh& mesh);

}  // namespace cascade
