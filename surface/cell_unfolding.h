// Where the neighbours of a cell lie when the surface around it is unfolded.
#pragma once

#include "surface/voronoi_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// A neighbour as a cell sees it, in the plane of the cell's triangle with the cell at the origin.
struct UnfoldedNeighbour {
    Vector2d place;
    /// The angle, in radians, by which the neighbour's own frame is turned against that of the cell
    /// when its triangle is laid into the cell's plane: what has direction φ in the neighbour's
    /// frame has φ + turn in the cell's.
    double turn = 0;
};

/// One for each of `cells.edges`, unfolded as the cells were (surface/unfolding.h). The turns of
/// the two sides of a Voronoi edge are each other's negatives. The same on any number of threads;
/// what it returns means nothing if `cancel` became true.
std::vector<UnfoldedNeighbour> unfold_neighbours(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                                 Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
