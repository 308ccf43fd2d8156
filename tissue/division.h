// Divides and removes cells.
#pragma once

#include "tissue/random_direction.h"
#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// The division or death of a cell.
struct CellEvent {
    std::uint32_t cell = 0;  ///< Its index in memory.
    bool dies = false;       ///< Otherwise it divides.
    double part = 1;         ///< The part of the step before the event.
    double left = 0;         ///< The time from the event to the end of the step.
    /// If `left` > 0: the cell's species at the event, and their mean rates from then to the end.
    std::vector<double> values = {}, mean_rates = {};
};

/// The parameters of new cells' positions.
struct DivisionPlaces {
    const Surroundings& surroundings;
    TissueSpecies species;
    std::uint32_t seed = 0, stage = 0;
};

/// The cells after a division.
struct Divided {
    bool has_moved = false;               ///< Whether the layout of the planes has changed.
    std::vector<std::uint32_t> children;  ///< In the order of their mothers' numbers.
    std::vector<std::uint32_t> mothers;   ///< The mothers of `children`.
    std::vector<std::uint32_t> moved;     ///< Other cells that have moved in memory.
};

/// Divides and removes cells, given in the order of their numbers. A new cell has all values of its
/// mother. The two are half her radius on either side of her position, along `directions` (one for
/// each dividing cell, in their order; random where it is 0 or missing). New cells get their
/// numbers in the order of their mothers' numbers. Throws std::bad_alloc.
Divided divide(Tissue& tissue, std::span<const CellEvent> events,
               std::span<const Vector3d> directions, const DivisionPlaces& places);

}  // namespace cascade
