// Cutting the hole that a point leaves into triangles.
#pragma once

#include "mesh/flat.h"

#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// The one-ring of a point, which is the origin, in a plane: distances are kept, and the angles
/// between neighbours, given one after the other, are scaled to a full turn, or to half a turn
/// between the first and the last where the point is at a boundary (one angle less than distances):
/// the geodesic polar map of W. Welch and A. Witkin, "Free-Form Shape Design Using Triangulated
/// Surfaces", SIGGRAPH 1994. Unlike in a projection to the tangent plane the triangles never
/// overlap.
std::vector<Vector2d> unroll(std::span<const double> distances, std::span<const double> angles);

/// Corners, as numbers of points of a ring, counterclockwise.
using RingTriangle = std::array<std::uint32_t, 3>;

/// Whether a triangle may be made. Its first and third corner are joined by a new edge if they are
/// not neighbours on the ring.
using MayMake = std::function<bool(const RingTriangle& corners)>;

/// Cuts the ears off a ring around the origin until a triangle is left, each time the one whose
/// circle reaches least far beyond the origin, which makes the Delaunay triangulation of a convex
/// ring (O. Devillers, "On deletion in Delaunay triangulations", SoCG 1999); an ear that may not be
/// made waits for another to change it. Of an open ring the first and the last point are no tips of
/// ears. Returns the triangles in order, the last what is left; nothing where no ear can be cut.
/// O(n log n) but for those that may not be made.
std::vector<RingTriangle> cut_ears(std::span<const Vector2d> ring, bool is_closed,
                                   const MayMake& may_make);

/// How good a triangle would be, 0 if it may not be made.
using Worth = std::function<double(const RingTriangle& corners)>;

/// Of all ways to cut a ring of `count` points into triangles the one whose worst triangle is best,
/// found by G. T. Klincsek's dynamic programming ("Minimal triangulations of polygonal domains",
/// 1980) in O(n³). Returns the triangles as cut_ears() does; nothing if there is no way.
std::vector<RingTriangle> best_triangles(std::uint32_t count, const Worth& worth);

}  // namespace cascade
