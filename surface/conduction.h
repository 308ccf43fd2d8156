// Areas and weights of a surface's cells and Voronoi edges in steps of diffusion.
#pragma once

#include "surface/surface_cells.h"

#include <vector>

namespace cascade {

struct Conduction {
    std::vector<double> areas;  ///< By cell, in square units.
    std::vector<double> flows;  ///< The weights of edges: the same for both cells, never negative.
};

/// The tightest cell limits the step of all, so a few cells count as looser than they are. A cell
/// is tight if the sum of its weights is large for its area. Among spread cells this loosens a few
/// in several thousand. Faces and points of a mesh may all be tighter than that: the tightest
/// thousandth is loosened. As single edges of slivers may conduct a hundred times as much as
/// others, these are limited before areas grow. `unit` is in lengths of the model.
Conduction conduction_of(const SurfaceCells& cells, bool are_spread, double unit);

}  // namespace cascade
