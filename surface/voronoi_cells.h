// Voronoi cells around places of a surface.
#pragma once

#include "core/parallel.h"
#include "surface/anisotropy.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// The Voronoi region of each place among its neighbours, unfolded into the plane of its triangle
/// (G. Turk, thesis, 1992, section 4.4). A region is cut by the triangles that it covers, so that
/// Voronoi edges end at boundaries and lengths are those on the surface. Regions unfolded in
/// different planes do not agree exactly: their lengths and distances are averaged, and the areas
/// that cells claim of a triangle are scaled to the triangle's area. All areas plus `bare_area` sum
/// to the surface's area. The same on any number of threads. Undefined if `cancel` became true.
SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel, const Anisotropy* anisotropy = nullptr);

}  // namespace cascade
