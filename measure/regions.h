// Counts spots, which are connected regions of cells with values above or below a threshold.
#pragma once

#include "measure/samples.h"

#include <cstdint>

namespace cascade::measure {

struct Regions {
    /// The number of connected regions of cells with values above the threshold.
    std::int64_t above = 0;
    /// The number of connected regions of the cells with values at or below the threshold.
    std::int64_t below = 0;
    /// The fraction of the domain's cells with values above the threshold, 0 … 1.
    double area = 0;
};

/// Finds the regions above and below the threshold `level`. Cells are connected by their sides,
/// also across periodic boundaries.
Regions find_regions(const Samples& samples, double level);

}  // namespace cascade::measure
