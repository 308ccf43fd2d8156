// Curvatures at the points of a mesh.
//
// They have the unit of one over the model's unit and are positive where the surface is convex: a
// sphere of radius r has 1/r everywhere. All results are finite on any mesh; those from few or
// badly shaped triangles are rough estimates. For values between points see surface/place_values.h.
#pragma once

#include "mesh/surface_mesh.h"

#include <vector>

namespace cascade {

/// Outward unit normals: the mean of the normals of the triangles around each point, with weights
/// that make it exact on a sphere (N. Max, "Weights for computing vertex normals from facet
/// normals", Journal of Graphics Tools 4(2), 1999).
std::vector<Vector3d> sphere_normals(const SurfaceMesh& mesh);

/// The mixed area of each point: the part of the surface that is nearer to it than to the other
/// corners of acute triangles, and a fixed share of obtuse ones (M. Meyer, M. Desbrun, P. Schröder
/// and A. Barr, "Discrete differential-geometry operators for triangulated 2-manifolds", 2003,
/// section 3.3). They sum to the area of the surface.
std::vector<double> point_areas(const SurfaceMesh& mesh);

/// One value per point each.
struct PrincipalCurvatures {
    std::vector<double> high, low;         ///< The largest and the smallest over all directions.
    std::vector<Vector3d> high_direction;  ///< The direction of `high`, of length 1.
    std::vector<Vector3d> low_direction;   ///< The direction of `low`, perpendicular to the other.

    double mean(std::size_t point) const { return (high[point] + low[point]) / 2; }
    double gaussian(std::size_t point) const { return high[point] * low[point]; }
};

/// The second fundamental form fitted to the differences of point normals along the edges of each
/// triangle, averaged over the triangles around each point (S. Rusinkiewicz, "Estimating curvatures
/// and their derivatives on triangle meshes", 3DPVT 2004, section 3). Converges under refinement
/// with well-shaped triangles; directions are arbitrary where both curvatures are equal.
PrincipalCurvatures principal_curvatures(const SurfaceMesh& mesh);

/// The Gaussian curvature as an angle: 2π minus the angles around each point; at a boundary π minus
/// the angles, which is the turn of the boundary (Meyer et al., section 4). The sum is 2π times the
/// Euler characteristic up to rounding. Divided by `point_areas` it is a curvature.
std::vector<double> angle_defects(const SurfaceMesh& mesh);

/// The smallest radius of curvature as G. Turk estimates it (thesis, 1992, section 4.6.3): the
/// minimum over the edges PQ from each point, each taken as a chord of a circle perpendicular to
/// the point's normal (|tan θ| |P − Q| / 2), then averaged `rounds` times with the neighbours'
/// values; Turk averages once. In addition to Turk, radii are limited to the diagonal of the
/// bounding box, since a flat surface has no such circle. Positive, unless an edge is parallel to
/// its point's normal.
std::vector<double> turk_radii(const SurfaceMesh& mesh, int rounds = 1);

}  // namespace cascade
