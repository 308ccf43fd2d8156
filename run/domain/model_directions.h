// Directions on a model, by the settings of scripts: the directions in which its cells are
// stretched (`directions` and `stretch` of a domain), and the directions of `along`.
#pragma once

#include "core/parallel.h"
#include "lang/program/program.h"
#include "surface/anisotropy.h"

#include <atomic>
#include <vector>

namespace cascade {

/// A direction for each triangle. Directions are lines without a sign: v and −v are the same. A
/// direction left open by the settings, such as an axis normal to the surface, is filled from the
/// neighbours. The same with any number of threads. Meaningless if `cancel` became true.
std::vector<Vector3d> direction_lines(const DirectionSettings& settings, const SurfaceMesh& mesh,
                                      Team& team, const std::atomic<bool>& cancel);

/// These directions, and the same ratio for each triangle.
Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
