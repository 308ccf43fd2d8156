// The cells of a grid that belong to a domain with a mask.
#pragma once

#include "core/grid.h"
#include "core/plane.h"

#include <cstdint>
#include <limits>

namespace cascade {

struct DomainMask {
    Mask inside;  ///< 1 in cells of the domain, else 0. Its halo is not filled.
    /// One word for each cell, with a bit for each of the 27 cells around it and itself, by the
    /// numbers of their offsets (lang/lower/pass_planner.h): set if the cell there is inside.
    /// Beyond a side the boundary decides: the opposite cell, or the one at the side itself.
    Field neighbourhood;
    std::int64_t cells = 0;  ///< The number of cells inside.
};

/// Makes a mask from values: a cell is inside if its value is neither 0 nor NaN (nor denormal,
/// which counts as 0 everywhere in the language).
DomainMask make_domain_mask(const Field& values, const Grid& grid);

/// The cells that do not change: frozen cells (nullptr: none) and cells outside.
Mask still_cells(const DomainMask& mask, const Mask* frozen);

/// A copy of a field with `value` in every cell that is outside.
Field with_outside(const Field& field, const DomainMask& mask, float value);

/// The value outside the mask in files and pictures.
inline constexpr float nothing_outside = std::numeric_limits<float>::quiet_NaN();

}  // namespace cascade
