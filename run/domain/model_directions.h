// Finds directions on a model. Scripts define two kinds of them: the directions in which cells are
// stretched (`directions` and `stretch` of a domain), and the directions of `along`.
#pragma once

#include "core/parallel.h"
#include "lang/program/program.h"
#include "surface/anisotropy.h"

#include <atomic>
#include <vector>

namespace cascade {

/// Returns a direction for each triangle. Directions have no sign, so v and −v are the same. Where
/// the settings give no direction, for example because an axis is normal to the surface, the
/// direction is interpolated from the neighbouring triangles. The result does not depend on the
/// number of threads. It is meaningless if `cancel` became true.
std::vector<Vector3d> direction_lines(const DirectionSettings& settings, const SurfaceMesh& mesh,
                                      Team& team, const std::atomic<bool>& cancel);

/// Returns the directions of direction_lines() together with a ratio of stretch that is the same in
/// all triangles.
Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
