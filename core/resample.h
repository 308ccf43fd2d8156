// Planes of the same domain on finer and coarser grids.
#pragma once

#include "core/plane.h"

namespace cascade {

/// The grid of the same domain whose cells are `times` as wide. The sides of axes of more than one
/// cell must be multiples of it; an axis of one cell stays as it is.
Grid coarser(const Grid& grid, std::int64_t times);

/// On a coarser grid: the mean of the cells that a cell covers, summed in binary64 row by row.
template <typename Number>
Plane<Number> restricted(const Plane<Number>& fine, const Grid& fine_grid, const Grid& coarse_grid);

/// On a grid twice as fine: between the four nearest cells (two on a line, eight in a volume), of
/// which the nearest counts 3/4 along each axis. Fills the halo of `coarse` by its sides.
template <typename Number>
Plane<Number> refined(Plane<Number>& coarse, const Grid& coarse_grid, const Grid& fine_grid,
                      const SideRules& sides);

extern template Plane<float> restricted(const Plane<float>&, const Grid&, const Grid&);
extern template Plane<double> restricted(const Plane<double>&, const Grid&, const Grid&);
extern template Plane<float> refined(Plane<float>&, const Grid&, const Grid&, const SideRules&);
extern template Plane<double> refined(Plane<double>&, const Grid&, const Grid&, const SideRules&);

}  // namespace cascade
