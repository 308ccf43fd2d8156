// In which directions the cells of a model are stretched: `directions` and `stretch` of a domain.
#pragma once

#include "core/parallel.h"
#include "lang/program/program.h"
#include "surface/anisotropy.h"

#include <atomic>

namespace cascade {

/// A direction and a ratio for each triangle. Directions are lines without a sign: v and −v are the
/// same. Where what is asked for leaves one open, as an axis does that stands upright on the
/// surface, it is filled from around. The same on any number of threads; means nothing if `cancel`
/// became true.
Anisotropy anisotropy_of(const DirectionSettings& settings, double stretch, const SurfaceMesh& mesh,
                         Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
