// The old surface with places among its points: the first part of G. Turk's re-tiling ("Texturing
// Surfaces Using Reaction-Diffusion", thesis, 1992, section 5.3.1).
#pragma once

#include "core/result.h"
#include "mesh/flat.h"
#include "mesh/half_edges.h"

#include <atomic>
#include <span>

namespace cascade {

struct MutualTessellation {
    /// A place that lies on an old point has its number; the others have new ones.
    std::vector<std::uint32_t> point_of_place;
    /// Of the old surface at each point; length 1, or 0 at a place without area around it.
    std::vector<Vector3d> normals;
};

/// Cuts each triangle into triangles of its corners and the places in it: the constrained Delaunay
/// triangulation, its sides (with the places on them) the constraints. Turk chooses the shortest
/// edges first, in O(n²); here places are inserted one by one and edges flipped (C. L. Lawson,
/// "Software for C¹ surface interpolation", 1977), in a random order that is nearly along a curve
/// (N. Amenta, S. Choi and G. Rote, "Incremental constructions con BRIO", SoCG 2003), which takes
/// O(n log n). Every triangle turns as the one it lies in does, exactly (surface/place_lattice.h).
///
/// An edge that would be a second one between its points stays away.
///
/// `mesh` is half_edges(old); its points keep their numbers. Fails as to_lattice() does, where
/// there would be too many points to number, and when `cancel` becomes true.
Result<MutualTessellation> tessellate(HalfEdges& mesh, const SurfaceMesh& old,
                                      std::span<const SurfacePlace> places,
                                      const std::atomic<bool>& cancel);

}  // namespace cascade
