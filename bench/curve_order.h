// The order of cells along a curve that fills space, with which order_for_steps() is compared.
#pragma once

#include "core/vector3.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::bench {

/// The order along a Hilbert curve through the cube around all positions, with 2^21 boxes per side
/// (by J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004). Cells
/// in the same box keep their order. Cells without a position (NaN) come first, in their order. O(n
/// log n).
std::vector<std::uint32_t> order_along_curve(std::span<const Vector3d> positions);

}  // namespace cascade::bench
