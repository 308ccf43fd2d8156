// Retiling: a surface with new points (G. Turk, "Re-Tiling Polygonal Surfaces", Computer Graphics
// 26(2), SIGGRAPH 1992; also section 5.3.1 of his thesis "Texturing Surfaces Using
// Reaction-Diffusion", 1992).
//
// Inserts positions into the old triangles as points (surface/mutual_tessellation.h), removes the
// old points one by one (surface/remove_points.h), and finally flips edges to improve triangles.
// The topology never changes, so the surface cannot tear.
#pragma once

#include "core/result.h"
#include "mesh/flat.h"

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The reason why a point could not be removed.
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
    /// The new surface. Point i of it is position i. The remaining old points follow, in order.
    /// Attributes of the old surface are interpolated linearly within its triangles. Texture
    /// coordinates are dropped.
    SurfaceMesh mesh;
    std::vector<KeptPoint> kept;
};

/// The surface as triangles whose corners are the positions, in their order. It has the same
/// components, boundaries and Euler characteristic as `mesh`, and no two points are joined by two
/// edges unless two edges already joined them in `mesh`. The normal of a triangle differs by less
/// than 90° from the mean of the old normals at its corners, unless it differed by more before. Old
/// points stay where a boundary bends or has no positions, where there are too few positions for
/// the topology (a sphere needs 4 points, a torus 7), and where the triangles without them would be
/// upside down. A point is within 10⁻⁷ of its position, relative to the old triangle. If positions
/// coincide, all but the first move by some 4·10⁻⁶.
///
/// The result is the same in every run. Takes O((n + m) log (n + m)) for n points and m positions
/// if no point has very many neighbours. Fails if a position is on no triangle, as half_edges()
/// does, if there would be more points or triangles than can be indexed, and when `cancel` becomes
/// true. Throws std::bad_alloc.
Result<Retiled> retile(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                       const std::atomic<bool>& cancel);

/// Makes an attribute of the new surface from `values`, one for each position. An old point that
/// remains gets the mean of its neighbours that have a value. The old points next to positions come
/// first. Points of components without positions get NaN.
PointAttribute attribute_of(const Retiled& retiled, std::string name,
                            std::span<const float> values);

}  // namespace cascade
