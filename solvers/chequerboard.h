// Do neighbours alternate, as they do when a time step is too long for diffusion?
#pragma once

#include "core/links.h"
#include "core/plane.h"

namespace cascade {

/// The part of a field that alternates from cell to cell, 0 … 1: along all axes like a
/// chequerboard, or along one of them as stripes of one cell. Measured in blocks of about 64 cells
/// that overlap, so that domains of opposite phase do not cancel and a part of a field is found. A
/// block counts where the correlation of neighbours is below −½, and further below 0 than white
/// noise would bring that many pairs by chance (4.5 standard deviations of Fisher's z); blocks that
/// hardly differ from an even field are passed over, and so are fields of fewer than 8 pairs. Of a
/// field of linked cells blocks are 64 cells that lie beside each other in memory, and the limit is
/// −0.3, for cells of which three are neighbours of each other cannot all alternate. `inside` says
/// which cells count; nullptr: all.
double alternating_part(const Field& field, const Mask* inside = nullptr,
                        const Links* links = nullptr);

/// Above this part the user is warned.
inline constexpr double chequerboard_threshold = 0.02;

}  // namespace cascade
