// Cell frames and bounds for diffusion along a direction on a surface.
#pragma once

#include "core/parallel.h"
#include "surface/conduction.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <vector>

namespace cascade {

/// Two perpendicular unit vectors in the plane of each cell's triangle. Seen from outside, with the
/// y axis of space upwards, they point like the axes of a picture. Where the normal is along the y
/// axis of space, as at the top of a sphere, the frame follows from the frames of surrounding
/// cells.
struct CellFrames {
    std::vector<Vector3d> right, down;
};
CellFrames cell_frames(const SurfaceMesh& mesh, const SurfaceCells& cells);

/// The evenness of each cell: the largest difference |a − b| / (a + b), 0 … 1, between the rates of
/// diffusion a along a direction and b across it at which no wave grows. `frames` are the frames of
/// the cells.
///
/// Links diffuse at the smaller of the two rates. The rest of the diffusion is a flow F, which in
/// each cell is a matrix times the least-squares gradient G. Cell i loses Σ w_ij (F_i + F_j) / 2 ·
/// c_ij, where c_ij are the straight lines to its neighbours. If G were the adjoint of this sum, Σ
/// F · G would be a decreasing energy. But G is another fit of the same differences: with M = Σ v
/// r_jᵀ, v = l r_j / |r_j|, over the neighbours at the unfolded positions r_j, G is the inverse of
/// M times Σ v (u_j − u_i). In the metric of the inverse of M, the flow F of a cell changes the
/// energy by at least
///
///     −½ |a − b|/2 (1/√(1 − σ²) + 2 √κ μ) Σ w (u_j − u_i)²
///
/// compared with ½ (a + b)/2 Σ w (u_j − u_i)² from the mean rate. Here κ is the ratio of the
/// eigenvalues of M, σ = (κ − 1) / (κ + 1), and μ² = Σ |w c − v|² / w. Evenness is the reciprocal
/// of the bracket: 1 in regular hexagons of a plane, at least 0.9 in most spread cells of smooth
/// surfaces, less beside sharp edges, and close to 0 in slivers.
std::vector<double> evenness_of_cells(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                      const CellFrames& frames, const Conduction& conduction,
                                      Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
