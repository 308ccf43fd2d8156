// The triangles between neighbouring cells, on which a value is interpolated linearly.
#pragma once

#include "surface/cell_frames.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// Three cells, in the order of a walk around their triangle. At each cell, the turn from the
/// previous cell's direction to the next cell's has the same sense as the turn from `right` to
/// `down` in CellFrames.
using CellTriangle = std::array<std::uint32_t, 3>;

struct CellTriangles {
    std::vector<CellTriangle> triangles;
    /// Pairs of cells in a triangle that share no Voronoi edge: first < second, in ascending order.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> diagonals;
};

/// The triangles of the graph that is dual to the Voronoi edges. Where more than three regions meet
/// in a point, as at the points of a mesh whose faces are cells, the polygon between their cells is
/// cut into triangles. Polygons of more than 64 cells, and boundaries of the surface, are left out.
/// `unfolded` are the neighbours' positions (unfolded_neighbours).
CellTriangles triangles_between(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                const CellFrames& frames, std::span<const Vector3d> unfolded);

}  // namespace cascade
