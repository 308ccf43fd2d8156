// The tangent planes of triangles or of cells, and how a direction goes from one to the next.
#pragma once

#include "core/parallel.h"
#include "surface/tangent_frame.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// A neighbour's plane, brought into that of its node as if the surface between them were unfolded:
/// parallel transport (K. Crane, M. Desbrun and P. Schröder, "Trivial connections on discrete
/// surfaces", 2010, for triangles).
struct TangentLink {
    std::uint32_t neighbour = 0;
    /// What has direction φ in the neighbour's frame has φ + turn here; the negative on the other
    /// side.
    double turn = 0;
    double distance = 0;  ///< Between the places of the two, in units of the model.
    double weight = 0;    ///< Length of what they share over the distance between them.
};

/// Nodes with a place and the frame of the place's triangle each.
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

/// One for each triangle, its place the middle; linked over Voronoi edges.
TangentPlanes planes_of_triangles(const SurfaceMesh& mesh);

/// One for each cell; linked over Voronoi edges. Means nothing if `cancel` became true.
TangentPlanes planes_of_cells(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team,
                              const std::atomic<bool>& cancel);

}  // namespace cascade
