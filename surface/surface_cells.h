// Cells that cover a surface, and the Voronoi edges between them: what diffusion on it needs to
// know.
#pragma once

#include "mesh/flat.h"

#include <span>
#include <vector>

namespace cascade {

/// The edge between two cells as each of them has it in its list.
struct VoronoiEdge {
    std::uint32_t neighbour = 0;
    double length = 0;    ///< Above 0.
    double distance = 0;  ///< Between the places of the two cells, along the surface; above 0.
    /// What flows through it is this times the difference of concentrations: no unit.
    double weight() const { return length / distance; }
};

/// Edges are symmetric: cell i has the edge to j with the same length and distance as j has it to
/// i. Boundaries of the surface have no edges. Whatever the cells are, diffusion is dc_i/dt = Σ_j
/// w_ij (c_j − c_i) / A_i with weights w = length / distance ≥ 0 and areas A (G. Turk, "Texturing
/// Surfaces Using Reaction-Diffusion", thesis, 1992, section 4.4).
struct SurfaceCells {
    std::vector<SurfacePlace> places;
    std::vector<double> areas;
    std::vector<std::size_t> ends;   ///< Cell i's edges end before edges[ends[i]].
    std::vector<VoronoiEdge> edges;  ///< Cell after cell, by the numbers of the neighbours.
    double bare_area = 0;            ///< Of components of the surface without any cell.

    std::span<const VoronoiEdge> edges_of(std::size_t cell) const {
        const std::size_t first = cell == 0 ? 0 : ends[cell - 1];
        return {edges.data() + first, ends[cell] - first};
    }
};

}  // namespace cascade
