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

/// A neighbouring plane. Directions are carried from plane to plane as if the surface between them
/// were unfolded. This is parallel transport (K. Crane, M. Desbrun and P. Schröder, "Trivial
/// connections on discrete surfaces", 2010).
struct TangentLink {
    std::uint32_t neighbour = 0;
    /// The angle between the two frames: a direction at angle φ in the neighbour's frame is at
    /// angle φ + turn in this frame. The link in the opposite direction has −turn.
    double turn = 0;
    double distance =
        0;              ///< The distance between the two planes' positions, in units of the model.
    double weight = 0;  ///< The length of the shared edge divided by the distance.
};

/// Positions on the surface, each with the frame of its triangle, and the links between them.
struct TangentPlanes {
    std::vector<SurfacePlace> places;
    std::vector<TangentFrame> frames;
    std::vector<double> areas;
    std::vector<std::size_t> ends;  ///< The links of plane k end before links[ends[k]].
    std::vector<TangentLink> links;

    std::size_t size() const { return places.size(); }
    std::span<const TangentLink> links_of(std::size_t node) const {
        const std::size_t first = node == 0 ? 0 : ends[node - 1];
        return {links.data() + first, ends[node] - first};
    }
};

/// One plane for each triangle, at its centroid, linked over its edges.
TangentPlanes planes_of_triangles(const SurfaceMesh& mesh);

/// With arrows, v and −v are different directions. With lines, v and −v are the same, and either
/// may be returned.
enum class DirectionKind { arrows, lines };

/// Projects vectors, one per plane, into the planes, and scales them to length 1. A direction is
/// unknown if its vector is not finite, or if the projection is shorter than `least_part` of the
/// longest vector. Starting next to known planes, each unknown direction becomes the mean of the
/// neighbours' directions, transported as if the surface were unfolded. In a component without
/// known directions one plane gets its x axis. Results are finite unit vectors.
std::vector<Vector3d> directions(const TangentPlanes& planes, std::span<const Vector3d> vectors,
                                 DirectionKind kind, double least_part = 1e-6);

/// The direction of `axis`, which may have any length, projected into each plane.
std::vector<Vector3d> axis_directions(const TangentPlanes& planes, Vector3d axis,
                                      DirectionKind kind);

/// The gradient at each plane's position, for values given at the points of the mesh and linear in
/// each triangle. The vectors are in values per unit of length. They are input for directions().
/// For values of cells see surface/cell_gradient.h.
std::vector<Vector3d> gradients_of_points(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                          std::span<const double> values);

enum class Principal { high, low };
/// Lines along which the curvature is highest or lowest, as input for directions(). The length of a
/// vector is the difference of the two curvatures, or 0 if they differ by less than a thousandth.
std::vector<Vector3d> curvature_lines(const SurfaceMesh& mesh, const TangentPlanes& planes,
                                      const PrincipalCurvatures& curvature, Principal which);

}  // namespace cascade
