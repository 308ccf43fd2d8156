// Surfaces that are given by a function of space: where it is 0.
#pragma once

#include "core/result.h"
#include "mesh/surface_mesh.h"

#include <atomic>
#include <functional>
#include <span>

namespace cascade {

/// Sets values[k] to the function at points[k], for all k; above 0 is inside. Called by one thread,
/// mostly with whole slices of equal z.
using ImplicitFunction =
    std::function<void(std::span<const Vector3d> points, std::span<double> values)>;

struct ImplicitRequest {
    Vector3d low{-1, -1, -1}, high{1, 1, 1};  ///< The box in which the surface lies, as a whole.
    double edge = 0.05;                       ///< How long the sides of triangles should be, about.
};

/// The most points at which a box is looked at, and triangles that the first cut may have.
inline constexpr double most_lattice_points = 3e8;
inline constexpr std::size_t most_cut_triangles = std::size_t{1} << 24;

/// At how many points the function is looked at to find the surface: twice the box's volume over
/// the cube of the edge. Some hundred more are needed for each corner of the triangles, to bring it
/// there.
double lattice_points(const ImplicitRequest& request);

/// The surface f = 0 as closed components of even triangles that face outwards, with corners on it.
/// The function is looked at on a lattice of corners and centres of cells as wide as `edge`; the
/// tetrahedra between them are cut where it changes its sign (A. Doi and A. Koide, "An Efficient
/// Method of Triangulating Equi-Valued Surfaces", IEICE Transactions E74(1), 1991), which leaves no
/// choice and so always closes; then triangles are made even and their corners brought onto f = 0
/// along the normals, by regula falsi between places inside and outside. What is thinner than
/// `edge` may be lost or torn, sharp edges are blunted by as much; the error of area and volume is
/// of second order in `edge` elsewhere.
///
/// A surface that meets the side of the box is refused: a cut is better said in the function, as
/// min(f, g) with a g above 0 inside the part that is wanted. Fails, too, naming the place, where
/// the function is not finite, where it is nowhere above 0, and on boxes of more than
/// `most_lattice_points`. When `cancel` becomes true the work ends with a Failure. `progress` is
/// told the part that is done, from 0 to 1. Throws std::bad_alloc.
Result<SurfaceMesh> implicit_surface(const ImplicitFunction& function,
                                     const ImplicitRequest& request,
                                     const std::atomic<bool>& cancel,
                                     const std::function<void(double)>& progress = {});

}  // namespace cascade
