// Areas and weights of a surface's cells and Voronoi edges in steps of diffusion.
#pragma once

#include "surface/surface_cells.h"

#include <vector>

namespace cascade {

struct Conduction {
    std::vector<double> areas;  ///< The area of each cell, in units of `unit` squared.
    std::vector<double> flows;  ///< The weights of edges, equal on both sides and never negative.
};

/// The weights and areas to use for diffusion. A cell is tight if the sum of its weights is large
/// for its area. The tightest cell limits the time step of all cells, so the tightest cells get
/// larger areas than they have. If the cells are spread (`are_spread`), there is a fixed limit,
/// which affects a few in several thousand cells. Cells that are faces or points of a mesh may all
/// exceed this limit, so only the tightest thousandth of them is changed. A single edge of a sliver
/// may conduct a hundred times as much as other edges. Such edges are limited before areas are
/// increased. `unit` is the unit of length, in lengths of the model.
Conduction conduction_of(const SurfaceCells& cells, bool are_spread, double unit);

}  // namespace cascade
