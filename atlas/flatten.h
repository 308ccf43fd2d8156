// Flattening of a chart that preserves the shapes of its triangles as well as possible.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Sets the rotation of each of the chart's triangles to the triangle's direction when the surface
/// is viewed along `axis`.
void turn_towards(const SurfaceMesh& mesh, Vector3d axis, Chart& chart);

/// Computes the chart's positions, beginning with the rotations stored in it, in at most `rounds`
/// rounds (at least 1). Each round finds the positions whose edges are nearest to the edges of the
/// rotated triangles, then the best rotations for these positions. L. Liu et al., "A Local/Global
/// Approach to Mesh Parameterization", Computer Graphics Forum 27(5), 2008 ("as rigid as
/// possible"). The result may overlap itself. It is not finite if the arithmetic fails. It has the
/// same bits in every run.
void flatten(const SurfaceMesh& mesh, Chart& chart, int rounds);

}  // namespace cascade
