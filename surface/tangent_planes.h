// The tangent planes of triangles, and the transport of directions between them.
#pragma once

#include "surface/tangent_frame.h"
#include "mesh/flat.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A neighbouring plane. Directions are transported as if the surface between the planes were
/// unfolded: parallel transport (K. Crane, M. Desbrun and P. Schröder, "Trivial connections on
/// discrete surfaces", 2010).
struct TangentLink {
    std::uint32_t neighbour = 0;
    /// Direction φ in the neighbour's frame is φ + turn here; the other side has the negative turn.
    double turn = 0;
    double distance = 0;  ///< Between the places of the two, in units of the model.
    double weight = 0;    ///< Length of the shared edge over the distance.
};

/// Nodes, each with a place and the frame of the place's triangle.
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

/// One plane for each triangle, at its centroid; linked over its edges.
TangentPlanes planes_of_triangles(const SurfaceMesh& mesh);

}  // namespace cascade
