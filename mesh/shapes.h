// Built-in surfaces of nearly equilateral triangles, closed and facing outwards. Their centre is
// the origin. y points up and z to the front, as in most models.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

namespace cascade {

/// A tube with at least this radius intersects itself.
inline constexpr double most_knot_radius = 0.6;

/// A tube around the curve (sin φ + 2 sin 2φ, cos φ − 2 cos 2φ, −sin 3φ). Its rings do not twist
/// around the curve, except for a rotation that makes the ends of the tube meet. This rotation is
/// spread evenly over the tube's length. Texture coordinates run along the curve, and around the
/// tube. `edge` is the approximate length of the triangles' edges. Fails unless `radius` is below
/// `most_knot_radius`.
Result<SurfaceMesh> knot_mesh(double radius, double edge);

/// The largest number of triangles of a shape.
inline constexpr double most_shape_triangles = 1 << 24;
/// The limits of a shape's lengths.
inline constexpr double least_shape_length = 1e-60, largest_shape_length = 1e60;

// The functions below fail if a length is outside 10⁻⁶⁰ … 10⁶⁰, or if the shape has more than
// `most_shape_triangles`. They throw std::bad_alloc. Their argument `edge` is the approximate
// length of the triangles' edges.

/// An icosahedron with each side cut into n² triangles. A point on a side has a weight w for each
/// corner of the side. The point is the normalised sum of the corners, each multiplied by sin(w ×
/// the angle between the ends of an edge). This cuts edges into equal parts. The texture
/// coordinates are the longitude, from the back via −x, and the latitude. In a triangle that
/// crosses the seam at the back, longitudes continue beyond 1. A corner at a pole has the longitude
/// of the triangle's centre.
Result<SurfaceMesh> sphere_mesh(double radius, double edge);

/// A tube of `tube_radius` around a circle around the y axis. The circle's radius `ring_radius` is
/// the larger one. Texture coordinates run around the ring from the back via −x, and around the
/// tube from inside via below.
Result<SurfaceMesh> torus_mesh(double ring_radius, double tube_radius, double edge);

/// A box with sharp edges. Each side is a lattice of rectangles cut along alternating diagonals.
/// Texture coordinates form the net of the box, with left, front, right and back side by side, and
/// top and bottom above and below the front, all at one scale.
Result<SurfaceMesh> box_mesh(Vector3d sides, double edge);

}  // namespace cascade
