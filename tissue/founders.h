// The first cells of a tissue: their positions and orientations.
#pragma once

#include "core/result.h"
#include "core/vector3.h"
#include "tissue/surroundings.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// The probability, 0 … 1, of accepting a founder at each of these positions. NaN counts as 0.
using FounderChance = std::function<std::vector<double>(std::span<const NearPlace> places)>;

/// `count` random positions, uniform by area on a surface and by volume in a box. Without a chance,
/// position k depends only on the surroundings, `seed`, `stage` and k. With a chance, tries these
/// positions one after another until `count` are accepted. Fails if fewer than one in ten thousand
/// is accepted.
Result<std::vector<NearPlace>> random_founders(const Surroundings& surroundings, std::size_t count,
                                               std::uint32_t seed, std::uint32_t stage,
                                               const FounderChance& chance = {});

/// For each of these points, which must be finite, the nearest position of the surroundings.
std::vector<NearPlace> founders_at(const Surroundings& surroundings,
                                   std::span<const Vector3d> points);

/// The rotation from the axes of space to a right-handed frame with y along `ey` and z as near to
/// `ez` as possible, as a quaternion of length 1: w, x, y, z. The vectors may have any length. If
/// they do not determine an axis, because they are 0, parallel or not finite, any direction
/// perpendicular to the determined axes is chosen.
std::array<double, 4> rotation_to(Vector3d ey, Vector3d ez);

}  // namespace cascade
