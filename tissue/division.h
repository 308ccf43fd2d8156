// Divides cells and removes others.
#pragma once

#include "tissue/random_direction.h"
#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A cell divides or dies.
struct CellEvent {
    std::uint32_t cell = 0;  ///< By place in memory.
    bool dies = false;       ///< Else it divides.
    double part = 1;         ///< Of the step, after which that happens.
    double left = 0;         ///< The time from then to the end of the step.
    /// If that is above 0: the cell's species then, and their mean rates up to the end.
    std::vector<double> values = {}, mean_rates = {};
};

/// What decides where new cells are.
struct DivisionPlaces {
    const Surroundings& surroundings;
    TissueSpecies species;
    std::uint32_t seed = 0, stage = 0;
};

/// The cells after a division.
struct Divided {
    bool has_moved = false;               ///< The layout of the planes has changed.
    std::vector<std::uint32_t> children;  ///< In the order of their mothers' numbers,
    std::vector<std::uint32_t> mothers;   ///< which are these.
    std::vector<std::uint32_t> moved;     ///< Others that are elsewhere in memory.
};

/// Lets cells divide and die, which are given in the order of their numbers. A new cell has all
/// values of its mother; the two are half her radius on either side of her place, along
/// `directions` (one for each cell that divides, in their order; where it is 0 or missing, at
/// random). New cells get their numbers in the order of their mothers' numbers. Throws
/// std::bad_alloc.
Divided divide(Tissue& tissue, std::span<const CellEvent> events,
               std::span<const Vector3d> directions, const DivisionPlaces& places);

}  // namespace cascade
