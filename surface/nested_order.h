// Nested sets of cells, each spread uniformly over the surface.
#pragma once

#include "surface/surface_cells.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Orders all cells so that the first n of them, for any n, are spread uniformly. Each cell is as
/// far as possible from all cells before it, measured along the edges between cells (T. F.
/// Gonzalez, "Clustering to Minimize the Maximum Intercluster Distance", 1985). Hence the distance
/// between any two of the first n cells is at least the distance from the next cell to the nearest
/// of the n cells. Begins with cell 0, followed by one cell of each other component of the surface.
/// Takes O(n log² n) for n cells. Throws std::bad_alloc.
std::vector<std::uint32_t> nested_order(const SurfaceCells& cells);

}  // namespace cascade
