// Detects alternating neighbours, which appear when a time step is too long for diffusion.
#pragma once

#include "core/links.h"
#include "core/plane.h"

namespace cascade {

/// The fraction of a field that alternates from cell to cell, 0 … 1: along all axes, like a
/// chequerboard, or along one axis, as stripes one cell wide.
///
/// The field is examined in overlapping blocks of about 64 cells. So parts that alternate with
/// opposite phase do not cancel, and an alternation in a small part of the field is found, too. A
/// block alternates if the correlation of neighbours is below −½, and also too low for white noise
/// with the same number of pairs (by 4.5 standard deviations of Fisher's z). Almost uniform blocks
/// and blocks with fewer than 8 pairs do not alternate. On grids of at least 2¹⁵ cells, only every
/// few bands of blocks are examined. In a field of linked cells a block is 64 cells adjacent in
/// memory, and the limit is −0.3, because three mutual neighbours cannot all alternate.
///
/// `inside` marks the cells that count. If it is null, all cells count.
double alternating_part(const Field& field, const Mask* inside = nullptr,
                        const Links* links = nullptr);

/// The user is warned if the alternating fraction is larger than this.
inline constexpr double chequerboard_threshold = 0.02;

}  // namespace cascade
