// Assembles Voronoi edges, added in any order, into the edges of cells.
#pragma once

#include "surface/surface_cells.h"

#include <vector>

namespace cascade {

class VoronoiEdgeList {
public:
    /// Adds an edge between two cells. Merges edges of the same pair. Ignores edges from a cell to
    /// itself and edges without length. `distance` is positive.
    void add(std::uint32_t a, std::uint32_t b, double length, double distance);

    /// Sets the edges of cells 0 … count − 1. The length of a merged edge is the sum of the
    /// lengths. Its distance is chosen so that its weight, length / distance, is the sum of the
    /// weights. The order of calls of add() only affects rounding.
    void put_into(SurfaceCells& cells, std::size_t count);

private:
    struct Edge {
        std::uint32_t from = 0, to = 0;
        double length = 0, weight = 0;
    };
    std::vector<Edge> edges_;
};

}  // namespace cascade
