// Curvatures at the points of a mesh.
//
// The unit of curvatures is the reciprocal of the model's unit. Curvatures are positive where the
// surface is convex: a sphere of radius r has 1/r everywhere. All results are finite on any mesh.
// Results from few or badly shaped triangles are rough estimates. surface/place_values.h gives
// values between points.
#pragma once

#include "mesh/surface_mesh.h"

#include <vector>

namespace cascade {

/// Outward unit normals. Each is the mean of the normals of the triangles around the point, with
/// weights that make it exact on a sphere (N. Max, "Weights for computing vertex normals from facet
/// normals", Journal of Graphics Tools 4(2), 1999).
std::vector<Vector3d> sphere_normals(const SurfaceMesh& mesh);

/// Each list has one value per point.
struct PrincipalCurvatures {
    std::vector<double> high, low;  ///< The largest and the smallest curvature over all directions.
    std::vector<Vector3d> high_direction;  ///< The direction of `high`, of length 1.
    /// The direction of `low`, perpendicular to `high_direction`.
    std::vector<Vector3d> low_direction;

    double mean(std::size_t point) const { return (high[point] + low[point]) / 2; }
    double gaussian(std::size_t point) const { return high[point] * low[point]; }
};

/// Fits the second fundamental form to the differences of point normals along the edges of each
/// triangle, and averages it over the triangles around each point (S. Rusinkiewicz, "Estimating
/// curvatures and their derivatives on triangle meshes", 3DPVT 2004, section 3). With well-shaped
/// triangles, the result converges as the mesh is refined. Directions are arbitrary where both
/// curvatures are equal.
PrincipalCurvatures principal_curvatures(const SurfaceMesh& mesh);

/// The smallest radius of curvature by G. Turk's estimate (thesis, 1992, section 4.6.3). Each edge
/// PQ from a point is taken as a chord of a circle perpendicular to the point's normal, of radius
/// |tan θ| |P − Q| / 2. The smallest radius at each point is averaged `rounds` times with the radii
/// at its neighbours. Turk averages once. Unlike Turk's estimate, radii are limited to the diagonal
/// of the bounding box, because a flat surface has no such circle. Positive, unless an edge is
/// parallel to its point's normal.
std::vector<double> turk_radii(const SurfaceMesh& mesh, int rounds = 1);

}  // namespace cascade
