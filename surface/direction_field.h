// Direction fields on a surface, for anisotropic diffusion.
//
// A field has one unit vector in space for each tangent plane. Undetermined directions are filled
// in from their surroundings.
#pragma once

#include "mesh/flat.h"
#include "surface/curvature.h"
#include "surface/tangent_frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A neighbouring plane. Directions are transported as if the surface between the planes were
/// unfolded: parallel transport (K. Crane, M. Desbrun and P. Schröder, "Trivial connections on
/// discrete surfaces", 2010).
struct TangentLink {
    std::uint32_t neighbour = 0;
    /// Direction φ in the neighbour's frame is φ + turn here. The other side has the negative turn.
    double turn = 0;
    double distance = 0;  ///< Between the two positions, in units of the model.
    double weight = 0;    ///< The length of the shared edge over the distance.
};

/// Nodes, each with a position and the frame of its triangle.
struct TangentPlanes {
    std::vector<SurfacePlace> places;
    std::vector<TangentFrame> frames;
    std::vector<double> areas;
    std::vector<std::size_t> ends;  ///< Node k's links end before links[ends[k]].
    std::vector<TangentLink> links;

    std::size_t size() const { return places.size(); }
    std::span<const TangentLink> links_of(std::size_t node) const {
        const std::size_t first = node == 0 ? 0 : ends[node - 1];
        return {links.data() + first, ends[node] - first};
    }
};

/// One plane for each triangle, at its centroid, linked over its edges.
TangentPlanes planes_of_triangles(const SurfaceMesh& mesh);

/// Whether v and −v are different directions. Lines are returned as either of the two vectors.
enum class DirectionKind { arrows, lines };

/// Projects vectors, one per plane, into the planes. If a vector is not finite, or its projection
/// is shorter than `least_part` of the longest vector, the plane gets the mean of its neighbours'
/// directions, transported as if the surface were unfolded, from the known planes outwards. In a
/// component without known directions one plane gets its x axis. Results are finite unit vectors.
std::vector<Vector3d> directions(const TangentPlanes& planes, std::span<const Vector3d> vectors,
                                 DirectionKind kind, double least_part = 1e-6);

/// The projection of an axis of any length into each plane: `directions` of one vector everywhere.
std::vector<Vector3d> axis_directions(const TangentPlanes& planes, Vector3d axis,
                                      DirectionKind kind);

/// The gradient, at each plane's position, of values at the points of the mesh, linear in each
/// triangle: vectors for `directions`, per unit of the model. For cells see
/// surface/cell_gradient.h.
std::vector<Vector3d> gradients_of_points(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                          std::span<const double> values);

enum class Principal { high, low };
/// Lines along which the curvature is highest or lowest, as vectors for `directions`. Their length
/// is the difference of the two curvatures, or 0 if it is less than a thousandth of them.
std::vector<Vector3d> curvature_lines(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                      const PrincipalCurvatures& curvature, Principal which);

}  // namespace cascade
