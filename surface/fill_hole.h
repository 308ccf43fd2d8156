// Triangulates the hole left by a removed point.
#pragma once

#include "mesh/flat.h"

#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// Maps the one-ring of a point to a plane, with the point at the origin. Preserves distances.
/// Scales the angles between consecutive neighbours so that they sum to a full turn. At a boundary
/// there is one angle fewer than distances, and the angles sum to half a turn. This is the geodesic
/// polar map of W. Welch and A. Witkin, "Free-Form Shape Design Using Triangulated Surfaces",
/// SIGGRAPH 1994. Unlike in a projection to the tangent plane, the triangles never overlap.
std::vector<Vector2d> unroll(std::span<const double> distances, std::span<const double> angles);

/// The corners of a triangle, counterclockwise, as indices of points of a ring.
using RingTriangle = std::array<std::uint32_t, 3>;

/// Returns whether a triangle may be made. Each new triangle adds an edge between its first and
/// third corner unless these are adjacent.
using MayMake = std::function<bool(const RingTriangle& corners)>;

/// Cuts ears off a ring around the origin until a triangle is left. Always cuts the ear whose
/// circumcircle reaches least far beyond the origin. For a convex ring this gives the Delaunay
/// triangulation (O. Devillers, "On deletion in Delaunay triangulations", SoCG 1999). An ear that
/// is not allowed is tried again when a neighbouring ear changes it. The first and the last point
/// of an open ring are never ears. Returns the triangles in the order of cutting, with the triangle
/// that is left at the end. If no allowed ear is left before, returns no triangles. O(n log n), not
/// counting ears that are not allowed.
std::vector<RingTriangle> cut_ears(std::span<const Vector2d> ring, bool is_closed,
                                   const MayMake& may_make);

/// The quality of a triangle, or 0 if the triangle is not allowed.
using Worth = std::function<double(const RingTriangle& corners)>;

/// The triangulation of a ring of `count` points whose worst triangle is as good as possible, by
/// the dynamic programming of G. T. Klincsek ("Minimal triangulations of polygonal domains", 1980),
/// in O(n³). Returns the triangles in the order of cut_ears(), or no triangles if there is no
/// triangulation.
std::vector<RingTriangle> best_triangles(std::uint32_t count, const Worth& worth);

}  // namespace cascade
