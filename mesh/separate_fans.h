// Separates fans of triangles that share only a point.
#pragma once

#include "mesh/surface_mesh.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Gives each fan of triangles its own point: two triangles keep a common point only if edges at
/// this point connect them. Keeps points in order and drops unused ones. Returns the old index of
/// each new point. The caller must update `points` and `attributes`.
std::vector<std::uint32_t> separate_fans(SurfaceMesh& mesh);

}  // namespace cascade
