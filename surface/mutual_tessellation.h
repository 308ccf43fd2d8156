// Inserts positions into a surface as points: the first part of G. Turk's re-tiling ("Texturing
// Surfaces Using Reaction-Diffusion", thesis, 1992, section 5.3.1).
#pragma once

#include "core/result.h"
#include "mesh/flat.h"
#include "mesh/half_edges.h"

#include <atomic>
#include <span>

namespace cascade {

struct MutualTessellation {
    /// The point of each position: an old point if the position coincides with one, otherwise a new
    /// point.
    std::vector<std::uint32_t> point_of_place;
    /// The unit normal of the old surface at each point. 0 where no area surrounds the point.
    std::vector<Vector3d> normals;
};

/// Triangulates each triangle with its corners and the positions in it. The result is the
/// constrained Delaunay triangulation, in which the triangle's sides, divided by the positions on
/// them, are edges. Turk adds the shortest edges first, in O(n²). Here positions are inserted one
/// by one and edges flipped (C. L. Lawson, "Software for C¹ surface interpolation", 1977), in a
/// random order that is nearly along a curve (N. Amenta, S. Choi and G. Rote, "Incremental
/// constructions con BRIO", SoCG 2003), in O(n log n). Every new triangle has exactly the
/// orientation of the old triangle that contains it (surface/place_lattice.h). Edges that would
/// join two points a second time are left out.
///
/// `mesh` is half_edges(old). Its points keep their indices. Fails as to_lattice() does, if there
/// would be too many points to index, and when `cancel` becomes true.
Result<MutualTessellation> tessellate(HalfEdges& mesh, const SurfaceMesh& old,
                                      std::span<const SurfacePlace> places,
                                      const std::atomic<bool>& cancel);

}  // namespace cascade
