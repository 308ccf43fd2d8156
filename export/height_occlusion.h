// How much of the sky is seen from each cell of a plane with heights.
#pragma once

#include "core/parallel.h"
#include "export/flat_cells.h"

#include <span>
#include <vector>

namespace cascade {

/// For each cell the part, 0 … 1, of the light of an even sky that reaches level ground at its
/// height: the mean over 16 directions of cos² of the elevation of the horizon, 1 / (1 + t²), where
/// t is the steepest rise, at least 0, from the cell to a higher place in this direction. (N. Max,
/// "Horizon mapping: shadows for bump-mapped surfaces", The Visual Computer 4, 1988.) Rises below
/// 1/50 count for nothing. Heights that are not finite, and cells outside, hide nothing. The same
/// on any number of threads.
std::vector<float> height_occlusion(const FlatCells& cells, std::span<const float> heights,
                                    Team& team);

}  // namespace cascade
