// The look of cells that are painted grey.
#pragma once

#include "export/painted_cells.h"

#include <span>

namespace cascade::test {

/// Grey as bright as the first channel.
inline Colour grey(std::span<const float> values, const SurfacePlace&) {
    return {values[0], values[0], values[0]};
}

}  // namespace cascade::test
