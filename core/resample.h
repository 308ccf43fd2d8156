// Planes of one domain on finer and coarser grids.
#pragma once

#include "core/plane.h"

namespace cascade {

/// The grid of the same domain with cells `times` times as wide. The number of cells along each
/// axis must be a multiple of `times`, or 1. A single cell stays a single cell.
Grid coarser(const Grid& grid, std::int64_t times);

/// A plane on a coarser grid: each cell has the mean of its fine cells, summed in binary64.
template <typename Number>
Plane<Number> restricted(const Plane<Number>& fine, const Grid& fine_grid, const Grid& coarse_grid);

/// A plane on a grid twice as fine, interpolated from the four nearest cells (two on a line, eight
/// in a volume). The nearest cell has weight 3/4 along each axis. Fills the halo of `coarse` by the
/// rules `sides`.
template <typename Number>
Plane<Number> refined(Plane<Number>& coarse, const Grid& coarse_grid, const Grid& fine_grid,
                      const SideRules& sides);

/// The grid of the same domain with each cell divided into `times` along each axis. An axis with
/// one cell keeps one cell.
Grid finer_grid(const Grid& grid, std::int64_t times);

/// A plane on the grid that finer_grid() returns. Values between cells lie on the curves of
/// core/between_cells.h, first along the third axis, then along columns, then along rows. Beyond a
/// side that is not periodic, the values at the side are repeated.
template <typename Number>
Plane<Number> divided(const Plane<Number>& plane, const Grid& grid, std::int64_t times);

/// divided() for values from which a run continues: along each axis, each value stays in the range
/// of the four cells around it. On a periodic grid the mean stays the same up to rounding.
template <typename Number>
Plane<Number> divided_in_range(const Plane<Number>& plane, const Grid& grid, std::int64_t times);

extern template Plane<float> divided(const Plane<float>&, const Grid&, std::int64_t);
extern template Plane<double> divided(const Plane<double>&, const Grid&, std::int64_t);
extern template Plane<float> divided_in_range(const Plane<float>&, const Grid&, std::int64_t);
extern template Plane<double> divided_in_range(const Plane<double>&, const Grid&, std::int64_t);
extern template Plane<float> restricted(const Plane<float>&, const Grid&, const Grid&);
extern template Plane<double> restricted(const Plane<double>&, const Grid&, const Grid&);
extern template Plane<float> refined(Plane<float>&, const Grid&, const Grid&, const SideRules&);
extern template Plane<double> refined(Plane<double>&, const Grid&, const Grid&, const SideRules&);

}  // namespace cascade
