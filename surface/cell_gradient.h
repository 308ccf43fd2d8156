// The gradient, on a surface, of values given in its cells.
#pragma once

#include "surface/voronoi_cells.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Weights g, one vector for each of `cells.edges`, such that the gradient of f in cell i is
///
///     ∇f_i = Σ g_ij (f_j − f_i)    over the Voronoi edges of i, to the neighbours j.
///
/// The gradient is the vector in the plane of the cell's triangle, in space, that fits the
/// differences best by least squares. Neighbours are at their unfolded positions, weighted by the
/// edge's length divided by the distance, so that a vanishing edge has no influence (as in T.
/// Barth, "A 3-D upwind Euler solver for unstructured meshes", AIAA 91-1548, 1991). The fit is
/// exact for linear functions where the surface is flat or folded, and of first order where the
/// surface is curved. Its unit is the reciprocal of the model's unit. If the neighbours are
/// collinear, or their spread across a line is less than 3 % of the spread along it, the component
/// across the line is undetermined and set to 0. Without neighbours the gradient is 0. The result
/// is always finite and the same with any number of threads. It is undefined if `cancel` became
/// true.
std::vector<Vector3d> cell_gradient_weights(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                            Team& team, const std::atomic<bool>& cancel);

/// The positions of the neighbours that the fit uses, one for each of `cells.edges`. Each is a
/// vector in space from the cell to the neighbour after the surface has been unfolded into the
/// plane of the cell's triangle.
std::vector<Vector3d> unfolded_neighbours(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                          Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
