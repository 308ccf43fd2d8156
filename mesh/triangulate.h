// Polygons cut into triangles.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Cuts a polygon along diagonals into triangles of its corner numbers 0 … n − 1, which turn as it
/// does: a quadrilateral along the diagonal that lies inside, the shorter one if both do; others by
/// cutting off ears in the plane nearest to the polygon (G. H. Meisters, "Polygons have ears",
/// American Mathematical Monthly 82, 1975). A polygon that crosses itself is cut up somehow.
/// Appends to `triangles`. False for a polygon with so many dents that this would take more than
/// seconds.
bool triangulate(std::span<const Vector3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace cascade
