// Separation of cells at one position. They would never part by themselves.
#pragma once

#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <span>

namespace cascade {

/// Where several of `cells` share one position, on periodic planes also across sides, moves all but
/// the one with the least number by a hundredth of its radius, in a random direction that depends
/// only on `seed`, `stage` and its number and lies in the surface if there is one. Frozen cells and
/// those without a radius stay. Returns whether any has moved. The caller must then call
/// Tissue::pad(). Throws std::bad_alloc.
bool part_cells(Tissue& tissue, const TissueSpecies& species, const Surroundings& surroundings,
                std::uint32_t seed, std::uint32_t stage, std::span<const std::uint32_t> cells);

}  // namespace cascade
