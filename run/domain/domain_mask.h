// The cells of a grid that belong to a domain with a mask.
#pragma once

#include "core/grid.h"
#include "core/plane.h"

#include <cstdint>
#include <limits>

namespace cascade {

struct DomainMask {
    /// 1 in cells of the domain, and 0 in all other cells of the grid. In the halo, values are
    /// undefined.
    Mask inside;
    /// A word for each cell, with a bit for each of the 27 cells in its neighbourhood. The
    /// neighbourhood includes the cell itself. The bits are numbered as in
    /// lang/lower/pass_planner.h. A bit is set if its cell is inside the domain. Beyond a side of
    /// the grid, the boundary decides which cell the bit refers to: the cell at the opposite side,
    /// or the cell at this side.
    Field neighbourhood;
    std::int64_t cells = 0;  ///< The number of cells of the domain.
};

/// Makes a mask from values. A cell is inside unless its value is 0, denormal or NaN. Everywhere in
/// the language, denormal numbers count as 0.
DomainMask make_domain_mask(const Field& values, const Grid& grid);

/// Marks the cells that do not change: the cells outside the mask, and the cells in `frozen`. If
/// `frozen` is null, no cell inside the mask is marked.
Mask still_cells(const DomainMask& mask, const Mask* frozen);

/// Returns a copy of a field that has `value` in every cell outside the mask.
Field with_outside(const Field& field, const DomainMask& mask, float value);

/// The value of cells outside the mask in files and pictures.
inline constexpr float nothing_outside = std::numeric_limits<float>::quiet_NaN();

}  // namespace cascade
