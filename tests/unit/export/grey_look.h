// Paints cells grey.
#pragma once

#include "export/painted_cells.h"

#include <span>

namespace cascade::test {

/// A grey with the level of the first channel.
inline Colour grey(std::span<const float> values, const SurfacePlace&) {
    return {values[0], values[0], values[0]};
}

}  // namespace cascade::test
