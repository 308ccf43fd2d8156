// Curvatures at the points of a mesh.
//
// Their unit is the reciprocal of the model's. They are positive where the surface is convex: a
// sphere of radius r has 1/r everywhere. All results are finite on any mesh. Those from few or
// badly shaped triangles are rough estimates. For values between points see surface/place_values.h.
#pragma once

#include "mesh/surface_mesh.h"

#include <vector>

namespace cascade {

/// Outward unit normals: the mean of the normals of the triangles around each point, with weights
/// that make it exact on a sphere (N. Max, "Weights for computing vertex normals from facet
/// normals", Journal of Graphics Tools 4(2), 1999).
std::vector<Vector3d> sphere_normals(const SurfaceMesh& mesh);

/// One value per point.
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
/// with well-shaped triangles. Directions are arbitrary where both curvatures are equal.
PrincipalCurvatures principal_curvatures(const SurfaceMesh& mesh);

/// The smallest radius of curvature by G. Turk's estimate (thesis, 1992, section 4.6.3): the
/// minimum over the edges PQ from each point, each taken as a chord of a circle perpendicular to
/// the point's normal (|tan θ| |P − Q| / 2), averaged `rounds` times with the neighbours' values.
/// Turk averages once. Unlike Turk's, radii are at most the diagonal of the bounding box, because a
/// flat surface has no such circle. Positive, unless an edge is parallel to its point's normal.
std::vector<double> turk_radii(const SurfaceMesh& mesh, int rounds = 1);

}  // namespace cascade
