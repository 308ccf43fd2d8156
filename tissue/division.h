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
    std::uint32_t cell = 0;  ///< The cell's index in memory.
    bool dies = false;       ///< Whether the cell dies. If not, it divides.
    double part = 1;         ///< The fraction of the step before the event.
    double left = 0;         ///< The time from the event to the end of the step.
    /// Only if `left` > 0: the values of the cell's species at the event, and their mean rates from
    /// the event to the end of the step.
    std::vector<double> values = {}, mean_rates = {};
};

/// The parameters that determine the positions of new cells.
struct DivisionPlaces {
    const Surroundings& surroundings;
    TissueSpecies species;
    std::uint32_t seed = 0, stage = 0;
};

/// The cells that are new or have moved after divisions and deaths.
struct Divided {
    bool has_moved = false;               ///< Whether the layout of the planes has changed.
    std::vector<std::uint32_t> children;  ///< New cells, in the order of their mothers' numbers.
    std::vector<std::uint32_t> mothers;   ///< The mothers of `children`.
    std::vector<std::uint32_t> moved;     ///< Other cells that have moved in memory.
};

/// Applies events, which must be in the order of the cells' numbers. A new cell has all values of
/// its mother. The mother and the new cell are placed on opposite sides of the mother's position,
/// at a distance of half the mother's radius, along a direction. `directions` has one direction for
/// each dividing cell, in the same order. A direction that is 0 or missing is random. New cells get
/// their numbers in the order of their mothers' numbers. Throws std::bad_alloc.
Divided divide(Tissue& tissue, std::span<const CellEvent> events,
               std::span<const Vector3d> directions, const DivisionPlaces& places);

}  // namespace cascade
