// Directions along a surface, for diffusion that differs by direction.
//
// A field is one vector of length 1 for each of some tangent planes, those of triangles or of
// cells, in space. Where vectors that are asked for leave a direction open, it is filled from
// around.
#pragma once

#include "surface/curvature.h"
#include "surface/tangent_planes.h"

#include <span>
#include <vector>

namespace cascade {

/// Whether v and −v are different directions. Lines come with either of the two vectors.
enum class DirectionKind { arrows, lines };

/// Vectors brought into the planes, of which each has one. Where a vector is not finite, or less
/// than `least_part` of the longest of all is left of it in its plane, the plane takes the mean of
/// its neighbours, carried over as if the surface were unfolded, from what is known outwards. On a
/// component where nothing is known one plane takes the x axis of its frame. Always of length 1 and
/// finite.
std::vector<Vector3d> directions(const TangentPlanes& planes, std::span<const Vector3d> vectors,
                                 DirectionKind kind, double least_part = 1e-6);

/// Where an axis, of any length, points in each plane: `directions` of the same vector everywhere.
std::vector<Vector3d> axis_directions(const TangentPlanes& planes, Vector3d axis,
                                      DirectionKind kind);

/// The gradient of values at the points of the mesh, linear in each triangle, at each plane's
/// place: vectors for `directions`. In values by units of the model. For values of cells there is
/// surface/cell_gradient.h.
std::vector<Vector3d> gradients_of_points(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                          std::span<const double> values);

enum class Principal { high, low };
/// Lines along which curvature is highest or lowest, vectors for `directions`: as long as the two
/// curvatures differ, and 0 where they differ by less than a thousandth.
std::vector<Vector3d> curvature_lines(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                      const PrincipalCurvatures& curvature, Principal which);

}  // namespace cascade
