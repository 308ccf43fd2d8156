// Better triangles over the same points.
#pragma once

#include "surface/edited_mesh.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// Exchanges edges where the worse of their two triangles becomes better (TriangleQuality::score()): on a
/// plane that is Lawson's way to the Delaunay triangulation, whose smallest angles are the largest (R.
/// Sibson, "Locally equiangular triangulations", 1978). `normals` are those of the surface at the points.
/// No triangle is turned upside down and no two points get a second edge. Ends because
/// the scores of all triangles, sorted, grow with every exchange; returns how many there were. Stops early
/// when `cancel` becomes true.
std::size_t improve_edges(EditedMesh& mesh, std::span<const Vector3d> normals,
                          const std::atomic<bool>& cancel);

}  // namespace cascade
