// How a surface bends, at the points of its mesh.
//
// Curvatures are in one over the units of the model, positive where the surface bends away from its
// outside as a ball does: a sphere of radius r has 1/r everywhere. Everything is finite on any
// mesh; what is found on few or badly shaped triangles is a guess. Values between points:
// surface/place_values.h.
#pragma once

#include "mesh/surface_mesh.h"

#include <vector>

namespace cascade {

/// Of length 1, outwards: the mean of the normals of the triangles around each point, weighted so
/// that it is exact on a sphere (N. Max, "Weights for computing vertex normals from facet normals",
/// Journal of Graphics Tools 4(2), 1999).
std::vector<Vector3d> sphere_normals(const SurfaceMesh& mesh);

/// The part of the surface that is nearer to each point than to the others of its triangles, where
/// these are acute, and a share of the triangle where it is obtuse: the mixed area of M. Meyer,
/// M. Desbrun, P. Schröder and A. Barr, "Discrete differential-geometry operators for triangulated
/// 2-manifolds" (2003), section 3.3. Their sum is the area of the surface.
std::vector<double> point_areas(const SurfaceMesh& mesh);

/// One each per point.
struct PrincipalCurvatures {
    std::vector<double> high, low;         ///< The largest and the smallest over all directions.
    std::vector<Vector3d> high_direction;  ///< Along which `high` is found; of length 1.
    std::vector<Vector3d> low_direction;   ///< Along `low`, at right angles to the other.

    double mean(std::size_t point) const { return (high[point] + low[point]) / 2; }
    double gaussian(std::size_t point) const { return high[point] * low[point]; }
};

/// The second fundamental form that fits how the normals of points differ along the edges of each
/// triangle, averaged over the triangles around each point (S. Rusinkiewicz, "Estimating curvatures
/// and their derivatives on triangle meshes", 3DPVT 2004, section 3). Converges where the mesh is
/// refined with triangles of good shape; where both curvatures are the same the directions are any.
PrincipalCurvatures principal_curvatures(const SurfaceMesh& mesh);

/// The Gaussian curvature as an angle: 2π less the angles around each point, and π less them at a
/// boundary, where it is the turn of the boundary (Meyer et al., section 4). Their sum is 2π times
/// the Euler characteristic, exactly but for rounding. Divided by `point_areas` it is a curvature.
std::vector<double> angle_defects(const SurfaceMesh& mesh);

/// The least radius of curvature as G. Turk estimates it (thesis, 1992, section 4.6.3): the least
/// of all edges from a point, each taken as a chord of a circle that the point's normal is normal
/// to
/// (|tan θ| |P − Q| / 2), and then `rounds` times the mean with those of its neighbours; he takes
/// one. Where the surface is flat there is no such circle: no radius is larger than the diagonal of
/// the model's box, of which he does not speak. Above 0 but where an edge stands upright on the
/// surface.
std::vector<double> turk_radii(const SurfaceMesh& mesh, int rounds = 1);

}  // namespace cascade
