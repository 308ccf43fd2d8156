// What earlier runs found out about tilings.
#pragma once

#include "solvers/tiling.h"

#include <optional>

namespace cascade {

/// Of the steps of one stage.
class TilingMemory {
public:
    virtual ~TilingMemory() = default;
    /// The tiling that was found to be the fastest on so many threads, twice in a row so that no
    /// busy moment teaches anything; it may be one for other steps.
    virtual std::optional<Tiling> find(int threads) = 0;
    /// It was found to be the fastest, again perhaps.
    virtual void keep(int threads, const Tiling& tiling) = 0;
};

}  // namespace cascade
