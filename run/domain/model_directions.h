// The directions in which the cells of a model are stretched: `directions` and `stretch` of a
// domain.
#pragma once

#include "core/parallel.h"
#include "lang/program/program.h"
#include "surface/anisotropy.h"

#include <atomic>

namespace cascade {

/// A direction and a ratio for each triangle. Directions are lines without a sign: v and −v are the
/// same. Where the settings leave a direction open, such as an axis that is normal to the surface,
/// it is filled from the neighbours. The same with any number of threads; meaningless if `cancel`
/// became true.
Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
