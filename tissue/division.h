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

/// Cells to divide and to die at one moment, by place in memory; no cell is in both.
struct CellEvents {
    std::vector<std::uint32_t> dividing, dying;

    bool empty() const { return dividing.empty() && dying.empty(); }
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
};

/// Lets the cells divide and die. A new cell has all values of its mother; the two are half her
/// radius on either side of her place, along `directions` (one for each dividing cell, in the order
/// of `dividing`; where it is 0 or missing, at random). New cells get their numbers in the order of
/// their mothers' numbers. Throws std::bad_alloc.
Divided divide(Tissue& tissue, const CellEvents& events, std::span<const Vector3d> directions,
               const DivisionPlaces& places);

}  // namespace cascade
