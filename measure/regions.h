// Spots: the connected regions of a field above or below a level.
#pragma once

#include "measure/samples.h"

#include <cstdint>

namespace cascade::measure {

struct Regions {
    std::int64_t above = 0;  ///< Connected regions of cells above the level.
    std::int64_t below = 0;  ///< Connected regions of the other cells.
    double area = 0;         ///< Fraction of the domain's cells above the level, 0 … 1.
};

/// Cells are connected by their sides, also across periodic boundaries.
Regions find_regions(const Samples& samples, double level);

}  // namespace cascade::measure
