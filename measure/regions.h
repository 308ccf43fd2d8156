// Spots: the connected parts of a field above or below a level.
#pragma once

#include "measure/samples.h"

#include <cstdint>

namespace cascade::measure {

/// What lies above a level, and what does not.
struct Regions {
    std::int64_t above = 0;  ///< Connected parts of the cells above the level.
    std::int64_t below = 0;  ///< Connected parts of the others.
    double area = 0;         ///< Part of the domain's cells that are above it, 0 … 1.
};

/// Cells are connected by their sides, across the borders of periodic axes too.
Regions find_regions(const Samples& samples, double level);

}  // namespace cascade::measure
