// Implicit surfaces: the points where a function of space is 0.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <functional>
#include <span>

namespace cascade {

/// Sets values[k] to the value of the function at points[k], for all k. Values must be positive
/// inside. Only one thread calls the function, usually with whole layers of points that have the
/// same z.
using ImplicitFunction =
    std::function<void(std::span<const Vector3d> points, std::span<double> values)>;

struct ImplicitRequest {
    Vector3d low{-1, -1, -1}, high{1, 1, 1};  ///< The box that contains the surface.
    double edge = 0.05;                       ///< Approximate length of the edges of triangles.
};

/// The largest number of lattice points, and the largest number of triangles before remeshing.
inline constexpr double most_lattice_points = 3e8;
inline constexpr std::size_t most_cut_triangles = std::size_t{1} << 24;

/// The number of function evaluations needed to find the surface: twice the box's volume divided by
/// the cube of the edge. The projection then takes a few hundred evaluations for each corner of a
/// triangle.
double lattice_points(const ImplicitRequest& request);

/// The surface f = 0 as closed components of nearly equilateral triangles. Triangles face outwards,
/// and their corners are on the surface. Evaluates the function at the corners and centres of cells
/// of width `edge`. Cuts the tetrahedra between these points where the function changes its sign
/// (A. Doi and A. Koide, "An Efficient Method of Triangulating Equi-Valued Surfaces", IEICE
/// Transactions E74(1), 1991). This method has no ambiguous cases and always gives a closed
/// surface. Then remeshes the triangles and projects their corners onto f = 0 along the normals, by
/// regula falsi between points inside and outside. Parts thinner than `edge` may be lost or torn,
/// and sharp edges are rounded by about `edge`. Elsewhere the error of area and volume is of second
/// order in `edge`.
///
/// Fails if the surface meets a side of the box. To cut the surface, use min(f, g) where g is
/// positive inside the wanted part. Fails also, with the location, if the function is not finite,
/// if it is nowhere positive, if the box has more than `most_lattice_points`, and when `cancel`
/// becomes true. Reports progress from 0 to 1. Throws std::bad_alloc.
Result<SurfaceMesh> implicit_surface(const ImplicitFunction& function,
                                     const ImplicitRequest& request,
                                     const std::atomic<bool>& cancel,
                                     const std::function<void(double)>& progress = {});

}  // namespace cascade
