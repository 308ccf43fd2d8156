// Tilings that earlier runs found to be the fastest.
#pragma once

#include "solvers/tiling.h"

#include <optional>

namespace cascade {

/// The tilings of the steps of one stage.
class TilingMemory {
public:
    virtual ~TilingMemory() = default;
    /// The fastest tiling with this number of threads, if found twice in a row, so that a
    /// disturbance does not count. May be a tiling for other steps.
    virtual std::optional<Tiling> find(int threads) = 0;
    /// Records that this tiling was the fastest, perhaps again.
    virtual void keep(int threads, const Tiling& tiling) = 0;
};

}  // namespace cascade
