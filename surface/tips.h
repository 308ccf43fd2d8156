// The tips of a surface: the ends of legs, ears, horns and tails.
#pragma once

#include "core/vector3.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <cstddef>
#include <vector>

namespace cascade {

/// The peaks of the mean distance to all of the surface, along it (M. Hilaga, Y. Shinagawa, T.
/// Kohmura and T. Kunii, "Topology Matching for Fully Automatic Similarity Estimation of 3D
/// Shapes", 2001). A peak counts if its height over the pass to a higher one (its persistence; H.
/// Edelsbrunner, D. Letscher and A. Zomorodian, "Topological Persistence and Simplification", 2002)
/// is at least a twentieth of the highest peak's. By falling height, at most `most_tips`; a ball
/// has none. Of several connected components only the one with the largest area has tips.
/// Undefined if `cancel` became true. Throws std::bad_alloc.
std::vector<Vector3d> tips_of(const SurfaceMesh& mesh, const std::atomic<bool>& cancel);

inline constexpr std::size_t most_tips = 16;

}  // namespace cascade
