// Detects neighbours that alternate, which happens when a time step is too long for diffusion.
#pragma once

#include "core/links.h"
#include "core/plane.h"

namespace cascade {

/// The part of a field that alternates from cell to cell, 0 … 1: along all axes, like a
/// chequerboard, or along one of them, as stripes of one cell. It is measured in overlapping blocks
/// of about 64 cells, so that domains of opposite phase do not cancel and a part of the field is
/// enough. A block counts if the correlation of neighbours is below −½, and also further below 0
/// than white noise would bring it with the same number of pairs (4.5 standard deviations of
/// Fisher's z). Blocks that are almost even are skipped, and so are fields of fewer than 8 pairs.
/// Of more than 2¹⁵ cells of a grid, bands of blocks at equal distances stand for all.
/// In a field of linked cells a block is 64 cells that are adjacent in memory, and the limit is
/// −0.3, because three cells that are neighbours of each other cannot all alternate. `inside` says
/// which cells count; nullptr: all.
double alternating_part(const Field& field, const Mask* inside = nullptr,
                        const Links* links = nullptr);

/// The user is warned if the part is larger.
inline constexpr double chequerboard_threshold = 0.02;

}  // namespace cascade
