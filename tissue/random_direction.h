// Random directions in space and in tangent planes, made from hashes.
#pragma once

#include "core/vector3.h"

#include <cstdint>

namespace cascade {

/// The numbers that determine a random direction.
struct DirectionKey {
    std::uint32_t seed = 0, stage = 0;
    /// The numbers of two cells, which are equal for a founder.
    std::uint32_t mother = 0, child = 0;
};

/// A direction of length 1, uniformly distributed over all directions perpendicular to `normal`, or
/// over all directions if `normal` is 0.
Vector3d random_direction(const DirectionKey& key, Vector3d normal);

}  // namespace cascade
