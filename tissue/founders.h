// The first cells of a tissue: their places and the way they face.
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

/// The probability, 0 … 1, with which a founder would be accepted at each of these places; NaN
/// counts as 0.
using FounderChance = std::function<std::vector<double>(std::span<const NearPlace> places)>;

/// `count` random places, by area on a surface and by volume in a box. Without a chance, place k
/// depends on nothing but the surroundings, `seed`, `stage` and k; with one, as many of these
/// places are tried as are needed. Fails if fewer than one in ten thousand is accepted.
Result<std::vector<NearPlace>> random_founders(const Surroundings& surroundings, std::size_t count,
                                               std::uint32_t seed, std::uint32_t stage,
                                               const FounderChance& chance = {});

/// The places of the surroundings that are nearest to these points, which must be finite.
std::vector<NearPlace> founders_at(const Surroundings& surroundings,
                                   std::span<const Vector3d> points);

/// The rotation that turns the axes of space to a right-handed frame with the axes y along `ey` and
/// z as near to `ez` as that allows, as a quaternion of length 1: w, x, y, z. Vectors may have any
/// length; where they leave an axis open (0, parallel, or not finite), some perpendicular one is
/// taken.
std::array<double, 4> rotation_to(Vector3d ey, Vector3d ez);

}  // namespace cascade
