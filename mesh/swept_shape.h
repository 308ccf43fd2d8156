// Closed meshes of shapes given by formulas: rings from a root to a tip, as for thorns and hairs.
#pragma once

#include "core/result.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// The surface's point at the parameters t and s. t goes from 0 at the root to 1 at the tip. s goes
/// once around from 0 to 1, and is periodic. The function is called with t and s in these ranges
/// only, by one thread at a time.
using SweptSurface = std::function<Vector3d(double t, double s)>;

/// A number at the point of the surface with the parameters t and s.
using SweptNumber = std::function<double(double t, double s)>;

/// A surface given by its distance from a middle line, in planes across the line. In each plane, s
/// = 0 is the direction closest to the x axis. If the line goes upwards along y, s = 1/4 is the
/// direction of the z axis. The line counts as going upwards where its derivative is 0.
struct Tube {
    SweptNumber radius;
    std::function<Vector3d(double t)> middle;
};
SweptSurface surface_of(Tube tube);

/// The numbers of quadrilaterals along t and around into which a surface is cut, at least 2 along t
/// and 3 around. Each quadrilateral is cut into two triangles.
struct SweptFacets {
    std::uint32_t along = 8, around = 8;
    friend bool operator==(const SweptFacets&, const SweptFacets&) = default;
};

/// The largest number of facets in each of the two directions.
inline constexpr std::uint32_t most_swept_facets = 1024;

/// The accuracy of a mesh that follows a surface, in the surface's unit of length. Both members are
/// larger than 0.
struct SweptDetail {
    double longest_edge = 0.5;  ///< The triangles' longest edge.
    double tolerance = 0.01;    ///< The largest distance between edges and surface.
};

/// The numbers of facets with which swept_shape() meets `detail`. Finds nearly the smallest
/// numbers. Compares edges with the surface at a few points only, so the surface's curvature should
/// not change between these points. Fails as swept_shape() does, and if there would be more than
/// `most_swept_facets`.
Result<SweptFacets> facets_for(const SweptSurface& surface, const SweptDetail& detail);

/// The closed mesh through the surface's points at uniform distances in t and s. It faces outwards
/// whether s runs clockwise or counterclockwise. Normals are normals of the surface, by finite
/// differences. An end whose ring is a point (a pole) has a normal for each sector, so that the end
/// may be sharp. Any other end gets a flat cap. `shade`, 0 … 1, gives the shades of the mesh. Fails
/// where the surface or the shade is not finite, naming t and s, and if the surface encloses no
/// volume.
Result<TriangleMesh> swept_shape(const SweptSurface& surface, SweptFacets facets,
                                 const SweptNumber& shade = {});

}  // namespace cascade
