// Packing charts into a square.
#pragma once

#include "atlas/chart.h"

#include <atomic>
#include <span>

namespace cascade {

/// Rotates, moves and scales charts, all by one factor as large as possible, so that they lie in
/// the square 0 … 1², at least 1 / cells apart and half as far from its sides. Returns the factor,
/// or 0 if they do not fit or `cancel` became true. `cells` is in 8 … 4096. Always the same bits.
///
/// Charts become sets of cells of a grid. Each chart, the largest first, is put at the lowest free
/// position, in the best of four orientations. "Largest" has three meanings: the best one wins.
double pack_charts(std::span<Chart> charts, int cells, const std::atomic<bool>& cancel);

}  // namespace cascade
