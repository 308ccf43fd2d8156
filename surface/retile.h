// Retiling: a surface with new points (G. Turk, "Re-Tiling Polygonal Surfaces", Computer Graphics
// 26(2), SIGGRAPH 1992, which is section 5.3.1 of his thesis "Texturing Surfaces Using
// Reaction-Diffusion", 1992).
//
// Inserts positions into the old triangles as points (surface/mutual_tessellation.h), removes the
// old points one by one (surface/remove_points.h), and finally flips edges to improve triangles.
// The topology never changes, so nothing can tear.
#pragma once

#include "core/result.h"
#include "mesh/flat.h"

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Why a point could not be removed.
enum class WhyKept {
    boundary,  ///< The boundary would move, or get an edge much longer than the spacing.
    topology,  ///< Two points would get two edges, or a component or a boundary would vanish.
    fold,      ///< A new triangle would be upside down or have no area.
};

/// An old point that remains in the new surface.
struct KeptPoint {
    std::uint32_t old_point = 0;
    WhyKept why = WhyKept::topology;
};

struct Retiled {
    /// Point i is position i. The kept points follow, in order. Attributes of the old surface are
    /// interpolated linearly within its triangles. Texture coordinates are dropped.
    SurfaceMesh mesh;
    std::vector<KeptPoint> kept;
};

/// The surface as triangles whose corners are the positions, in their order. It has the same
/// components, boundaries and Euler characteristic, and no two points have two edges unless they
/// had before. The normal of a triangle differs by less than 90° from the mean of the old normals
/// at its corners, unless it did not before. Old points stay where a boundary bends or has no
/// positions, where too few positions remain for the topology (a sphere needs 4 points, a torus 7),
/// and where only triangles upside down could replace them. A point is within 10⁻⁷ of its position,
/// relative to the old triangle. Of coinciding positions, all but the first move by some 4·10⁻⁶.
///
/// Deterministic. Takes O((n + m) log (n + m)) for n points and m positions if no point has very
/// many neighbours. Fails if a position is on no triangle, as half_edges() does, if there would be
/// more points or triangles than it indexes, and when `cancel` becomes true. Throws std::bad_alloc.
Result<Retiled> retile(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                       const std::atomic<bool>& cancel);

/// Values at positions (one each) as an attribute of the new surface. A kept point gets the mean of
/// its neighbours with a value, starting next to positions. Components without positions get NaN.
PointAttribute attribute_of(const Retiled& retiled, std::string name,
                            std::span<const float> values);

}  // namespace cascade
