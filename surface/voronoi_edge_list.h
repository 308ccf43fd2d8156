// Voronoi edges in any order made into those of cells.
#pragma once

#include "surface/surface_cells.h"

#include <vector>

namespace cascade {

class VoronoiEdgeList {
public:
    /// An edge between two cells; several between the same two become one. One from a cell to
    /// itself is nothing, and so is one without length. `distance` is above 0.
    void add(std::uint32_t a, std::uint32_t b, double length, double distance);

    /// Sets the edges of cells 0 … count − 1. Those that were put together have the sum of the
    /// lengths and the distance with which that gives the sum of the weights. The order of adding
    /// matters to rounding only.
    void put_into(SurfaceCells& cells, std::size_t count);

private:
    struct Edge {
        std::uint32_t from = 0, to = 0;
        double length = 0, weight = 0;
    };
    std::vector<Edge> edges_;
};

}  // namespace cascade
