// Triangulates polygons.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Cuts a polygon along diagonals into triangles of its corners 0 … n − 1, with its orientation.
/// Cuts a quadrilateral along the diagonal that lies inside, or along the shorter one if both do.
/// Cuts other polygons by removing ears in the coordinate plane nearest to the polygon (G. H.
/// Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975). If the polygon
/// intersects itself, the triangles are arbitrary. Appends to `triangles`. Returns false without a
/// result if the polygon has so many reflex corners that cutting would take longer than a few
/// seconds.
bool triangulate(std::span<const Vector3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace cascade
