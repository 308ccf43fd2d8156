// Surfaces that need no file: sphere, torus and box, of even triangles, closed and facing outwards.
// Their centre is the origin; the y axis points up and z to the front, as in most models.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// The most triangles that a shape is made of.
inline constexpr double most_shape_triangles = 1 << 24;

// `edge` is how long the sides of triangles should be, about; all lengths are above 0, at most
// 10⁶⁰, and at least 10⁻⁶⁰. Fails, naming the length, on others, and where there were more than
// `most_shape_triangles`. Throws std::bad_alloc.

/// An icosahedron of which each side is cut into n² triangles. Points are not brought to the sphere
/// from the flat side: the weights w of its corners are taken as the sines of w times the angle of
/// an edge, so that edges are cut evenly. Texture: longitude from the back by way of −x, and
/// latitude; where a triangle crosses the seam at the back it goes on beyond 1, and at a pole its
/// longitude is that of the triangle's middle.
Result<SurfaceMesh> sphere_mesh(double radius, double edge);

/// A tube of `tube_radius` bent to a ring of `ring_radius`, which is larger, around the y axis.
/// Texture: around the ring from the back by way of −x, and around the tube from its inner side by
/// way of below.
Result<SurfaceMesh> torus_mesh(double ring_radius, double tube_radius, double edge);

/// With sharp edges; each side is a lattice of rectangles cut along every other diagonal. Texture:
/// the unfolded box, left, front, right and back beside each other, top and bottom above and below
/// the front, all to one scale.
Result<SurfaceMesh> box_mesh(Vector3d sides, double edge);

}  // namespace cascade
