// Laying a chart flat so that its triangles keep their shapes as well as they can.
#pragma once

#include "atlas/chart.h"

namespace cascade {

/// Turns a chart's triangles as they lie when seen against the direction `axis`.
void turn_towards(const SurfaceMesh& mesh, Vector3d axis, Chart& chart);

/// Finds places, beginning with the turns of the chart, in at most `rounds` rounds, ≥ 1: places for
/// which the edges are nearest to those of the turned triangles, then the best turns for these
/// places. L. Liu et al., "A Local/Global Approach to Mesh Parameterization", Computer Graphics
/// Forum 27(5), 2008 ("as rigid as possible"). Nothing keeps the result from overlapping itself; it
/// is not finite if the arithmetic fails. Always the same bits.
void flatten(const SurfaceMesh& mesh, Chart& chart, int rounds);

}  // namespace cascade
