// Nested sets of cells, each spread uniformly over the surface.
#pragma once

#include "surface/surface_cells.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Orders all cells so that each beginning is spread uniformly: a cell is as far as possible from
/// those before it, along the edges between cells (T. F. Gonzalez, "Clustering to Minimize the
/// Maximum Intercluster Distance", 1985). So no two of the first n are nearer to each other than
/// the next cell is to the nearest of them. Begins with cell 0, followed by one cell of each other
/// component of the surface. Takes O(n log² n) for n cells. Throws std::bad_alloc.
std::vector<std::uint32_t> nested_order(const SurfaceCells& cells);

}  // namespace cascade
