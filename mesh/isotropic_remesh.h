// Isotropic remeshing: nearly equilateral triangles.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <functional>
#include <span>

namespace cascade {

/// Projects points back to the original surface. `normals` are outward unit normals.
using BringBack =
    std::function<Result<void>(std::span<Vector3d> points, std::span<const Vector3d> normals)>;

/// Approaches equilateral triangles with edges of length `edge` by local changes that preserve the
/// surface's shape (M. Botsch and L. Kobbelt, "A Remeshing Approach to Multiresolution Modeling",
/// Symposium on Geometry Processing, 2004, section 4, without its splitting of long edges).
///
/// - Collapses edges shorter than 4/5 `edge` if that neither changes the topology nor folds the
///   surface.
/// - Flips edges until the two angles opposite each edge sum to at most 180°.
/// - Moves points along the surface to the centroid of the triangles around them, unless that would
///   turn a triangle over. Then projects the points to the original surface by `bring_back`.
///
/// The mesh must be closed, without texture coordinates, attributes and double edges. Fails if
/// `bring_back` fails, and as half_edges() does. Stops early when `cancel` becomes true. Throws
/// std::bad_alloc.
Result<void> isotropic_remesh(SurfaceMesh& mesh, double edge, const BringBack& bring_back,
                              const std::atomic<bool>& cancel);

}  // namespace cascade
