// Cells of a surface: the regions around places, and the walls between them.
#pragma once

#include "core/parallel.h"
#include "surface/anisotropy.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// A wall between two cells as each of them has it in its list.
struct CellWall {
    std::uint32_t neighbour = 0;
    double length = 0;
    double distance = 0;  ///< Between the places of the two cells, along the surface.
};

/// What diffusion needs to know of cells. Walls are symmetric: cell i has the wall to j with the same
/// length and distance as j has it to i. Boundaries of the surface have no walls.
struct SurfaceCells {
    std::vector<SurfacePlace> places;
    std::vector<double> areas;
    std::vector<std::size_t> ends;   ///< Cell i's walls end before walls[ends[i]].
    std::vector<CellWall> walls;     ///< Cell after cell, by the numbers of the neighbours.
    double bare_area = 0;            ///< Of pieces of the surface without any cell.

    std::span<const CellWall> walls_of(std::size_t cell) const {
        const std::size_t first = cell == 0 ? 0 : ends[cell - 1];
        return {walls.data() + first, ends[cell] - first};
    }
};

/// The Voronoi region of each place among those around it, unfolded into the plane of its triangle (G. Turk,
/// thesis, 1992, section 4.4). A region is cut up by the triangles that it covers, so that walls end
/// at boundaries and lengths are those on the surface. Two regions unfolded in different planes do not
/// agree exactly: the lengths and distances of a wall are averaged, and the areas that cells claim of a
/// triangle are scaled so that together they are the triangle. The sum of all areas and `bare_area` is
/// the surface's area. The same on any number of threads. What it returns means nothing if `cancel` became true.
SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel, const Anisotropy* anisotropy = nullptr);

}  // namespace cascade
