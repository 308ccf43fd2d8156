// Detects alternating neighbours, which appear when a time step is too long for diffusion.
#pragma once

#include "core/links.h"
#include "core/plane.h"

namespace cascade {

/// The fraction of a field that alternates from cell to cell, 0 … 1: along all axes, like a
/// chequerboard, or along one of them, as stripes of one cell. It is measured in overlapping blocks
/// of about 64 cells, so that domains of opposite phase do not cancel and a part of the field is
/// enough. A block counts if the correlation of neighbours is below −½ and further below 0 than
/// white noise would bring it with as many pairs (4.5 standard deviations of Fisher's z). Almost
/// uniform blocks and fields of fewer than 8 pairs are skipped. On grids of more than 2¹⁵ cells,
/// only bands of blocks at equal distances are measured. In a field of linked cells a block is 64
/// cells adjacent in memory, and the limit is −0.3, because three mutual neighbours cannot all
/// alternate. `inside` says which cells count; nullptr: all.
double alternating_part(const Field& field, const Mask* inside = nullptr,
                        const Links* links = nullptr);

/// Above this fraction, the user is warned.
inline constexpr double chequerboard_threshold = 0.02;

}  // namespace cascade
