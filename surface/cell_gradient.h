// The gradient on a surface of what is known in its cells.
#pragma once

#include "surface/voronoi_cells.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Weights g, one vector for each of `cells.edges`, such that the gradient of f in cell i is
///
///     ∇f_i = Σ g_ij (f_j − f_i)    over the Voronoi edges of i, j being what lies beyond.
///
/// It is the vector in the plane of the cell's triangle, in space, that fits the differences best
/// in the sense of least squares, neighbours being where the unfolded surface has them and counting
/// by the length of the edge over the distance, so that one that vanishes does not matter (T.
/// Barth, "A 3-D upwind Euler solver for unstructured meshes", AIAA 91-1548, 1991, has such fits).
/// Exact for linear functions where the surface is flat or only folded; of first order where it is
/// curved. Units are one over those of the model. Where neighbours lie on one line, or are spread
/// across it by less than 3 % of what they are along it, the part at right angles to it cannot be
/// known and is 0; without neighbours all is. Always finite. The same on any number of
/// threads; what it returns means nothing if `cancel` became true.
std::vector<Vector3d> cell_gradient_weights(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                            Team& team, const std::atomic<bool>& cancel);

/// The gradient in each cell of one value per cell.
std::vector<Vector3d> cell_gradients(const SurfaceCells& cells, std::span<const Vector3d> weights,
                                     std::span<const double> values);

}  // namespace cascade
