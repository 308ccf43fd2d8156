// Stores the tilings that earlier runs found to be the fastest.
#pragma once

#include "solvers/tiling.h"

#include <optional>

namespace cascade {

/// The tilings of the steps of one stage.
class TilingMemory {
public:
    virtual ~TilingMemory() = default;
    /// The tiling that was recorded as fastest with this number of threads. nullopt unless it was
    /// recorded twice in a row, so that a single disturbed measurement does not count. The tiling
    /// may have been found for steps that differ from the present ones.
    virtual std::optional<Tiling> find(int threads) = 0;
    /// Records that this tiling was the fastest. The same tiling may be recorded again and again.
    virtual void keep(int threads, const Tiling& tiling) = 0;
};

}  // namespace cascade
