// Packing charts into a square.
#pragma once

#include "atlas/chart.h"

#include <atomic>
#include <span>

namespace cascade {

/// Turns, moves and scales charts, all by one factor that is as large as is found, so that they lie
/// in the square 0 … 1², at least 1 / cells apart and half as far from its sides. Returns the
/// factor, or 0 if they do not fit or `cancel` became true. `cells` is in 8 … 4096. Always the same
/// bits.
///
/// Charts become sets of cells of a grid. Each, the largest first, is put to the lowest place that
/// is free, in the best of four orientations. "Largest" has three meanings; the best is taken.
double pack_charts(std::span<Chart> charts, int cells, const std::atomic<bool>& cancel);

}  // namespace cascade
