// The tips of a surface: the ends of legs, ears, horns and tails.
#pragma once

#include "core/vector3.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <cstddef>
#include <vector>

namespace cascade {

/// The positions of tips: the peaks of a function whose value at a position is the mean distance,
/// along the surface, to all other positions (M. Hilaga, Y. Shinagawa, T. Kohmura and T. Kunii,
/// "Topology Matching for Fully Automatic Similarity Estimation of 3D Shapes", 2001). A peak's
/// height is its persistence, measured from the pass to a higher peak (H. Edelsbrunner, D. Letscher
/// and A. Zomorodian, "Topological Persistence and Simplification", 2002). A peak counts if its
/// height is at least a twentieth of the highest peak's height, and at least 3 % of the mean of the
/// function. Returns at most `most_tips` positions, the highest peaks first. A ball has no tips.
/// Only the connected component with the largest area has tips. The result is undefined if `cancel`
/// became true. Throws std::bad_alloc.
std::vector<Vector3d> tips_of(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

inline constexpr std::size_t most_tips = 16;

}  // namespace cascade
