// Flattening of a chart that preserves the shapes of its triangles as well as possible.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Sets the rotations of a chart's triangles to their directions seen against `axis`.
void turn_towards(const SurfaceMesh& mesh, Vector3d axis, Chart& chart);

/// Computes positions, beginning with the rotations of the chart, in at most `rounds` rounds, ≥ 1.
/// Each round finds the positions whose edges are nearest to the edges of the rotated triangles,
/// then the best rotations for these positions. L. Liu et al., "A Local/Global Approach to Mesh
/// Parameterization", Computer Graphics Forum 27(5), 2008 ("as rigid as possible"). The result may
/// overlap itself, and is not finite if the arithmetic fails. Always the same bits.
void flatten(const SurfaceMesh& mesh, Chart& chart, int rounds);

}  // namespace cascade
