// Separates cells at the same position, which would never separate by themselves.
#pragma once

#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <span>

namespace cascade {

/// Moves cells apart that share a position. On periodic planes, positions at opposite sides count
/// as the same. Only the cells in the list `cells` are considered. The cell with the lowest number
/// stays. Each other cell moves by a hundredth of its radius in a random direction. The direction
/// is tangential to the surface, if there is one, and depends only on `seed`, `stage` and the
/// cell's number. Frozen cells and cells without a radius stay. Returns whether any cell has moved.
/// The caller must then call Tissue::pad(). Throws std::bad_alloc.
bool part_cells(Tissue& tissue, const TissueSpecies& species, const Surroundings& surroundings,
                std::uint32_t seed, std::uint32_t stage, std::span<const std::uint32_t> cells);

}  // namespace cascade
