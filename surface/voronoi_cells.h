// The regions around places of a surface as its cells.
#pragma once

#include "core/parallel.h"
#include "surface/anisotropy.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// The Voronoi region of each place among those around it, unfolded into the plane of its triangle
/// (G. Turk, thesis, 1992, section 4.4). A region is cut up by the triangles that it covers, so
/// that Voronoi edges end at boundaries and lengths are those on the surface. Two regions unfolded
/// in different planes do not agree exactly: the lengths and distances of one are averaged, and the
/// areas that cells claim of a triangle are scaled so that together they are the triangle. The sum
/// of all areas and `bare_area` is the surface's area. The same on any number of threads. What it
/// returns means nothing if `cancel` became true.
SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel, const Anisotropy* anisotropy = nullptr);

}  // namespace cascade
