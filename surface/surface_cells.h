// Cells that cover a surface, and the Voronoi edges between cells, for diffusion.
#pragma once

#include "mesh/flat.h"

#include <span>
#include <vector>

namespace cascade {

/// The edge between two cells, stored once for each cell.
struct VoronoiEdge {
    std::uint32_t neighbour = 0;
    double length = 0;  ///< Positive.
    double distance =
        0;  ///< The distance between the two cells' positions along the surface. Positive.
    /// The flow across the edge for a difference of 1 between the concentrations. Has no unit.
    double weight() const { return length / distance; }
};

/// Edges are symmetric: the edge from cell i to j has the same length and distance as the edge from
/// j to i. There are no edges at boundaries of the surface. For all kinds of cells diffusion is
/// dc_i/dt = Σ_j w_ij (c_j − c_i) / A_i with weights w = length / distance ≥ 0 and areas A (G.
/// Turk, "Texturing Surfaces Using Reaction-Diffusion", thesis, 1992, section 4.4).
struct SurfaceCells {
    std::vector<SurfacePlace> places;
    std::vector<double> areas;
    std::vector<std::size_t> ends;  ///< The edges of cell i end before edges[ends[i]].
    /// Edges of cell 0, then of cell 1, and so on. A cell's edges are sorted by neighbour.
    std::vector<VoronoiEdge> edges;
    double bare_area = 0;  ///< The area of the surface's components without cells.

    std::span<const VoronoiEdge> edges_of(std::size_t cell) const {
        const std::size_t first = cell == 0 ? 0 : ends[cell - 1];
        return {edges.data() + first, ends[cell] - first};
    }
};

}  // namespace cascade
