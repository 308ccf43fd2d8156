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

/// How far, from 0 to 1, diffusion may differ along and across a direction in each cell, as
/// |a − b| / (a + b) of its rates a and b, so that no wave grows. `frames` are those of the cells.
///
/// Links carry the smaller rate. The rest flows by F, in cells a matrix times G, the gradient by
/// least squares; of F, Σ w_ij (F_i + F_j) / 2 · c_ij leaves cell i, where c_ij are the straight
/// lines to its neighbours. If G were the adjoint of this, Σ F · G would be an energy that falls.
/// It is another fit of the same differences: with M = Σ v r_jᵀ, v = l r_j / |r_j|, of the
/// neighbours at r_j, unfolded, G is the inverse of M times Σ v (u_j − u_i). In the metric of that
/// inverse the rest of a cell takes at least
///
///     −½ |a − b|/2 (1/√(1 − σ²) + 2 √κ μ) Σ w (u_j − u_i)²
///
/// from the energy ½ (a + b)/2 Σ w (u_j − u_i)² of the mean rate, where κ is the ratio of the
/// eigenvalues of M, σ = (κ − 1) / (κ + 1), and μ² = Σ |w c − v|² / w. Evenness is one over that
/// bracket: 1 in regular hexagons of a plane, 0.9 and more in most spread cells of smooth surfaces,
/// less beside sharp edges, and next to nothing in slivers.
std::vector<double> evenness_of_cells(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                      const CellFrames& frames, const Conduction& conduction,
                                      Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
