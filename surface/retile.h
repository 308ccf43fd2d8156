// A surface over new points: G. Turk, "Re-Tiling Polygonal Surfaces" (Computer Graphics 26(2),
// SIGGRAPH 1992), which is section 5.3.1 of his "Texturing Surfaces Using Reaction-Diffusion"
// (thesis, 1992).
//
// The old triangles are cut so that the places are among their points
// (surface/mutual_tessellation.h), then the old points are taken away one by one
// (surface/remove_points.h), and at the end edges are flipped for better ones
// (surface/flip_edges.h). At every moment there is a surface of the same topology, so nothing
// can tear.
#pragma once

#include "core/result.h"
#include "mesh/flat.h"

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Why a point could not be taken away.
enum class WhyKept {
    boundary,  ///< The boundary would move, or have an edge much longer than places are apart.
    topology,  ///< Two points would have two edges, or a component or a boundary would vanish.
    fold,      ///< A new triangle would lie upside down or have no area.
};

/// A point of the old surface that is one of the new surface too.
struct KeptPoint {
    std::uint32_t old_point = 0;
    WhyKept why = WhyKept::topology;
};

struct Retiled {
    /// Point i is place i; after them come the kept points, in order. Attributes of the old surface
    /// are carried along, linear within its triangles; its texture is not.
    SurfaceMesh mesh;
    std::vector<KeptPoint> kept;
};

/// The surface as triangles whose corners are the places, in their order. It has the same
/// components, boundaries and Euler characteristic, and no two points have two edges if they had
/// not before. The normal of a triangle and the mean of the old normals at its corners are less
/// than 90° apart, unless it was so before. Old points stay where a boundary bends or has no
/// places, where too few places are left for the topology (a sphere takes 4 points, a torus 7), and
/// where only triangles upside down could replace them. A point lies within 10⁻⁷ of its place,
/// measured by the place's old triangle; where places coincide all but the first move by some
/// 4·10⁻⁶.
///
/// The same for the same arguments. Takes O((n + m) log (n + m)) of n points and m places, where no
/// point has very many neighbours. Fails where a place is on no triangle, as half_edges() does,
/// where there would be more points or triangles than it can number, and when `cancel` becomes
/// true. Throws std::bad_alloc.
Result<Retiled> retile(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                       const std::atomic<bool>& cancel);

/// Values of places as an attribute of the new surface. A kept point gets the mean of its
/// neighbours that have a value, those next to places first; on a component without any place all
/// stay NaN. `values` has one for each place.
PointAttribute attribute_of(const Retiled& retiled, std::string name,
                            std::span<const float> values);

}  // namespace cascade
