// Packs charts into a square.
#pragma once

#include "atlas/chart.h"

#include <atomic>
#include <span>

namespace cascade {

/// Rotates, moves and scales charts so that they lie in the square 0 … 1², at least 1 / cells apart
/// and half as far from the sides of the square. All are scaled by the same factor, which is as
/// large as possible. Returns the factor, or 0 if the charts do not fit or `cancel` became true.
/// `cells` is 8 … 4096. The result has the same bits in every run.
///
/// Each chart is represented by a set of cells of a grid. Beginning with the largest chart, each
/// gets the lowest free position in the best of four orientations. Charts are ordered by three
/// measures of size in turn, and the best result is used.
double pack_charts(std::span<Chart> charts, int cells, const std::atomic<bool>& cancel);

}  // namespace cascade
