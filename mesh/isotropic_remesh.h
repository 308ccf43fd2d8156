// Isotropic remeshing: triangles of nearly equal sides.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <functional>
#include <span>

namespace cascade {

/// Brings points back to the surface that the mesh stands for. `normals` are of length 1, outwards.
using BringBack =
    std::function<Result<void>(std::span<Vector3d> points, std::span<const Vector3d> normals)>;

/// Works towards edges as long as `edge` and triangles of equal sides, by local changes that keep
/// the surface's form (M. Botsch and L. Kobbelt, "A Remeshing Approach to Multiresolution
/// Modeling", Symposium on Geometry Processing, 2004, section 4, without its splitting of long
/// edges): edges shorter than 4/5 `edge` are collapsed where that neither changes the topology nor
/// folds the surface; edges are flipped until the angles that face them sum up to half a turn at
/// most; and points move along the surface to the middle of the triangles around them, after which
/// `bring_back` is asked, except for those that would turn a triangle over. The mesh is closed, has
/// neither texture nor attributes, and one edge at most between two points. Fails when `bring_back`
/// does and as half_edges() does; stops early when `cancel` becomes true. Throws std::bad_alloc.
Result<void> isotropic_remesh(SurfaceMesh& mesh, double edge, const BringBack& bring_back,
                              const std::atomic<bool>& cancel);

}  // namespace cascade
