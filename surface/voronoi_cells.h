// Voronoi cells around positions on a surface.
#pragma once

#include "core/parallel.h"
#include "surface/anisotropy.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// The region of each position in a Voronoi diagram of its neighbours, which are unfolded into the
/// plane of the position's triangle (G. Turk, thesis, 1992, section 4.4). Regions are clipped by
/// the triangles they cover, so that Voronoi edges end at boundaries and lengths are measured on
/// the surface. Regions unfolded in different planes do not agree exactly, so the lengths and
/// distances of the two sides are averaged. The areas that regions cover in a triangle are scaled
/// so that they sum to the triangle's area. All areas plus `bare_area` sum to the surface's area.
/// The result is the same with any number of threads. It is undefined if `cancel` became true.
SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel, const Anisotropy* anisotropy = nullptr);

}  // namespace cascade
