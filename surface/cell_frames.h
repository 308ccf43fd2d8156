// What diffusion in a direction needs of the cells of a surface.
#pragma once

#include "core/parallel.h"
#include "surface/conduction.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// Two perpendicular directions in the plane of each cell's triangle, as vectors of length 1. Seen
/// from outside, with y upwards, they point as the axes of a picture do. Where that is
/// undetermined, as at the top of a sphere, they are filled in from around.
struct CellFrames {
    std::vector<Vector3d> right, down;
};
CellFrames cell_frames(const SurfaceMesh& mesh, const SurfaceCells& cells);

/// How far, from 0 to 1, diffusion may differ along and across a direction in each cell, as (a - b)
/// / (a + b) of its rates a and b, so that no wave grows. `frames` are those of the cells.
///
/// A flow F in cells, A times the gradient of u by least squares, leaves cell i by
/// Σ w_ij (F_i + F_j) / 2 · c_ij, with the straight lines c_ij to its neighbours. Were the gradient
/// G the adjoint of that, the energy Σ F · G could not fall below 0. It differs by what the cell's
/// neighbours at r_ij and the lines differ. With M = Σ l/|r| r rᵀ, the links carrying the mean m of
/// the rates and the cells the rest, ± a − m along and across, the energy of cell i is at least
///
///     m/2 Σ w (u_j − u_i)² (1 − (a − m)/m (1/√(1 − σ²) + 2 √κ μ)),
///
/// where κ is the ratio of the eigenvalues of M, σ = (κ − 1) / (κ + 1), and
/// μ² = Σ |w c − l/|r| r|² / w in the metric of the inverse of M. Of regular hexagons in a plane σ
/// and μ are 0. Spread cells of a smooth surface have 0.95 and more, slivers next to nothing.
std::vector<double> evenness_of_cells(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                      const CellFrames& frames, const Conduction& conduction,
                                      Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
