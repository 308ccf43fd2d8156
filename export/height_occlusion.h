// The part of the sky that is visible from each cell of a plane with heights.
#pragma once

#include "core/parallel.h"
#include "export/flat_cells.h"

#include <span>
#include <vector>

namespace cascade {

/// For each cell, the fraction, 0 … 1, of a uniform sky's light that reaches level ground at the
/// cell's height. It is the mean over 16 directions of cos² of the elevation of the horizon, 1 / (1
/// + t²), where t is the steepest rise, at least 0, from the cell to a higher point in this
/// direction (N. Max, "Horizon mapping: shadows for bump-mapped surfaces", The Visual Computer 4,
/// 1988). Rises below 1/50 are ignored. Cells outside the domain and cells whose height is not
/// finite hide no sky. The result is the same with any number of threads.
std::vector<float> height_occlusion(const FlatCells& cells, std::span<const float> heights,
                                    Team& team);

}  // namespace cascade
