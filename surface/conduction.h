// What the cells of a surface and their Voronoi edges count as in steps of diffusion.
#pragma once

#include "surface/surface_cells.h"

#include <vector>

namespace cascade {

struct Conduction {
    std::vector<double> areas;  ///< By cell, in square units.
    std::vector<double> flows;  ///< By edge: its weight; the same for both cells, never below 0.
};

/// Steps of all cells are as short as the tightest ones need, so a few cells count as looser than
/// they are. Tight is a cell whose weights are a large sum for its area. Of spread cells a few in
/// some thousand count as larger. Faces and points of a mesh may all be tighter than that; of them
/// the tightest thousandth is loosened. As single edges of slivers may conduct a hundred times as
/// much as others, these are limited before areas grow. `unit` is in lengths of the model.
Conduction conduction_of(const SurfaceCells& cells, bool are_spread, double unit);

}  // namespace cascade
