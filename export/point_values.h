// What cells hold, at the points of the mesh.
#pragma once

#include "core/parallel.h"
#include "export/channels.h"
#include "surface/cell_filter.h"

#include <span>
#include <vector>

namespace cascade {

/// Per-cell channels filtered at every point of the mesh. Where a cell with a share is NaN the point is.
/// The same on any number of threads. Throws std::bad_alloc.
std::vector<Channel> at_points(const SurfaceMesh& mesh, const CellFilter& filter,
                               std::span<const Channel> cells, Team& team);

/// A place in a triangle for each point.
std::vector<SurfacePlace> places_of_points(const SurfaceMesh& mesh);

}  // namespace cascade
