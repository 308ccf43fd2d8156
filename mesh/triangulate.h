// Triangulation of polygons.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Cuts a polygon along diagonals into triangles of its corners 0 … n − 1, with its orientation.
/// Cuts a quadrilateral along the diagonal inside, the shorter one if both are, and other polygons
/// by removing ears in the coordinate plane nearest to the polygon (G. H. Meisters, "Polygons have
/// ears", American Mathematical Monthly 82, 1975). The result for a polygon that intersects itself
/// is arbitrary. Appends to `triangles`. Returns false if this would take more than seconds,
/// because the polygon has too many reflex corners.
bool triangulate(std::span<const Vector3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace cascade
