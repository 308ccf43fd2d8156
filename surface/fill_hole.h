// Cutting the hole that a point leaves into triangles.
#pragma once

#include "surface/flat.h"

#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// The points around a point, which is the origin, in a plane: their distances are kept, and the
/// angles between them, given one after the other, are scaled to a full turn, or to half a turn
/// between the first and the last where the fan is open (one angle less than distances): the geodesic
/// polar map of W. Welch and A. Witkin, "Free-Form Shape Design Using Triangulated Surfaces",
/// SIGGRAPH 1994. Unlike in a projection to the tangent plane the fan never overlaps itself.
std::vector<Vector2d> unroll(std::span<const double> distances, std::span<const double> angles);

/// Corners of a rim, counterclockwise.
using RimTriangle = std::array<std::uint32_t, 3>;

/// Whether a triangle may be made; `cuts` says that its third side is a new edge.
using MayMake = std::function<bool(const RimTriangle& corners, bool cuts)>;

/// Cuts the ears off a rim around the origin until a triangle is left, each time the one whose circle
/// reaches least far beyond the origin, which makes the Delaunay triangulation of a convex rim
/// (O. Devillers, "On deletion in Delaunay triangulations", SoCG 1999); an ear that may not be made waits
/// for another to change it. Of an open rim the first and the last point are no tips of ears. Returns
/// the triangles in order, the last what is left; nothing where no ear can be cut. O(n log n) but for
/// those that may not be made.
std::vector<RimTriangle> cut_ears(std::span<const Vector2d> rim, bool is_closed, const MayMake& may_make);

}  // namespace cascade
