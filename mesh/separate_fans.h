// A point for every fan of triangles.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Renumbers the corners of the triangles so that triangles share a point only where edges lead
/// from one to the next around it. The points' order is kept; those that no triangle uses are gone.
/// Returns for each new point the number of the one that it was: `points` and `attributes` are the
/// caller's.
std::vector<std::uint32_t> separate_fans(SurfaceMesh& mesh);

}  // namespace cascade
