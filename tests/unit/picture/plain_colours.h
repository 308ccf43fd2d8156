// Colours that tests of pictures draw with and look for.
#pragma once

#include "core/palette.h"

namespace cascade::test {

inline constexpr Colour red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

}  // namespace cascade::test
