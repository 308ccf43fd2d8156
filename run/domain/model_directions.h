// Directions on a model, by the settings of scripts: those in which its cells are stretched
// (`directions` and `stretch` of a domain), and those of `along`.
#pragma once

#include "core/parallel.h"
#include "lang/program/program.h"
#include "surface/anisotropy.h"

#include <atomic>
#include <vector>

namespace cascade {

/// A direction for each triangle. Directions are lines without a sign: v and −v are the same. Where
/// the settings leave a direction open, such as an axis that is normal to the surface, it is filled
/// from the neighbours. The same with any number of threads; meaningless if `cancel` became true.
std::vector<Vector3d> direction_lines(const DirectionSettings& settings, const SurfaceMesh& mesh,
                                      Team& team, const std::atomic<bool>& cancel);

/// These directions, and the same ratio for each triangle.
Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
