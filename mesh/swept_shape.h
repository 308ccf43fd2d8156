// Closed meshes of shapes given by formulas: rings from a root to a tip, as for thorns and hairs.
#pragma once

#include "core/result.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// A point of a surface. t goes from 0 at the root to 1 at the tip. s goes around, 0 … 1, and is
/// periodic. Called with t and s in these ranges only, by one thread at a time.
using SweptSurface = std::function<Vector3d(double t, double s)>;

/// A number at a point of such a surface.
using SweptNumber = std::function<double(double t, double s)>;

/// A surface by its distance from a middle line, in the planes across the line. In each plane, s
/// begins in the direction closest to the x axis, and s = 1/4 is, for a line upwards along y, the z
/// axis. A line that stands still counts as going upwards.
struct Tube {
    SweptNumber radius;
    std::function<Vector3d(double t)> middle;
};
SweptSurface surface_of(Tube tube);

/// The number of quadrilaterals, each of two triangles: at least 2 along t and 3 around.
struct SweptFacets {
    std::uint32_t along = 8, around = 8;
    friend bool operator==(const SweptFacets&, const SweptFacets&) = default;
};

/// The largest number of facets along t, and around.
inline constexpr std::uint32_t most_swept_facets = 1024;

/// How closely a mesh follows a surface, in the surface's unit of length. Both are larger than 0.
struct SweptDetail {
    double longest_edge = 0.5;  ///< The triangles' longest edge.
    double tolerance = 0.01;    ///< The largest distance between the edges and the surface.
};

/// The number of facets, nearly the least, with which swept_shape() meets a detail. Compares edges
/// with the surface at a few points, between which its curvature should not change. Fails as
/// swept_shape() does, and if there would be more than `most_swept_facets`.
Result<SweptFacets> facets_for(const SweptSurface& surface, const SweptDetail& detail);

/// The closed mesh through the surface at uniform distances of t and s, facing outwards whichever
/// way s runs. Normals are the surface's, by finite differences. An end whose ring is a point (a
/// pole) has a normal for each sector, so that it may be sharp. Any other end gets a flat cap.
/// `shade`, 0 … 1, gives the shades of the mesh. Fails where the surface or the shade is not
/// finite, naming t and s, and if the surface encloses no volume.
Result<TriangleMesh> swept_shape(const SweptSurface& surface, SweptFacets facets,
                                 const SweptNumber& shade = {});

}  // namespace cascade
