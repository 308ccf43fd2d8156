// Closed meshes of shapes that formulas give: rings from a root to a tip, as of thorns and hairs.
#pragma once

#include "core/result.h"
#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// A point of a surface. t goes from the root 0 to the tip 1; s goes around, 0 … 1, and is
/// periodic. Called with t and s in these ranges only, and by one thread at a time.
using SweptSurface = std::function<Vector3d(double t, double s)>;

/// A number at a point of such a surface.
using SweptNumber = std::function<double(double t, double s)>;

/// A surface by its distance from a middle line, in the planes across the line. In each of them s
/// begins in the direction closest to the x axis, and a quarter further is, for a line upwards
/// along y, the z axis. Where the line stands still it counts as going upwards.
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

/// How closely a mesh follows a surface, in the surface's unit of length; both larger than 0.
struct SweptDetail {
    double longest_edge = 0.5;  ///< Of triangles.
    double tolerance = 0.01;    ///< Largest distance between the edges and the surface.
};

/// A number of facets, nearly the least, with which swept_shape() keeps to a detail; edges are
/// compared with the surface at some places only, between which it should not change its bend.
/// Fails as swept_shape() does, and if there would be more than `most_swept_facets`.
Result<SweptFacets> facets_for(const SweptSurface& surface, const SweptDetail& detail);

/// The closed mesh through the surface at even distances of t and s, facing outwards whichever way
/// s runs. Normals are those of the surface, by differences. An end whose ring is a point (a pole)
/// has a normal for each sector, so that it may be sharp; any other end gets a flat cap. `shade`, 0
/// … 1, gives the shades of the mesh. Fails where the surface or the shade is not finite, naming t
/// and s, and if the surface encloses no volume.
Result<TriangleMesh> swept_shape(const SweptSurface& surface, SweptFacets facets,
                                 const SweptNumber& shade = {});

}  // namespace cascade
