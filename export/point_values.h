// Values of cells at other positions, such as at the points of a mesh.
#pragma once

#include "core/parallel.h"
#include "export/channels.h"
#include "surface/cell_filter.h"

#include <span>
#include <vector>

namespace cascade {

/// Each point of the mesh as a position in one of its triangles.
std::vector<SurfacePlace> places_of_points(const SurfaceMesh& mesh);

/// The values that the filter gives for each channel at `places`. A value is NaN if a cell with a
/// positive weight is NaN. The result is the same with any number of threads. Throws
/// std::bad_alloc.
std::vector<Channel> values_at(std::span<const SurfacePlace> places, const CellFilter& filter,
                               std::span<const Channel> cells, Team& team);

}  // namespace cascade
