// A tiling with a given number of levels.
#pragma once

#include "solvers/tiling.h"

namespace cascade::test {

inline Tiling levels(int count) {
    Tiling tiling;
    tiling.levels = count;
    return tiling;
}

}  // namespace cascade::test
