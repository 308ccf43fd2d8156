// Values of cells at other positions, such as the points of a mesh.
#pragma once

#include "core/parallel.h"
#include "export/channels.h"
#include "surface/cell_filter.h"

#include <span>
#include <vector>

namespace cascade {

/// A position in a triangle for each point.
std::vector<SurfacePlace> places_of_points(const SurfaceMesh& mesh);

/// Cell channels filtered at positions. NaN if a cell with a positive weight is NaN. The same on
/// any number of threads. Throws std::bad_alloc.
std::vector<Channel> values_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               std::span<const Channel> cells, Team& team);

}  // namespace cascade
