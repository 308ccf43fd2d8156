// Chooses few colours to represent many.
#pragma once

#include "core/palette.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Similar colours form a group, which is represented by its mean colour.
struct ColourGroups {
    std::vector<Colour> means;
    std::vector<std::uint32_t> group;  ///< The index of each colour's group.
};

/// Groups colours by median cut: P. Heckbert, "Color Image Quantization for Frame Buffer Display",
/// SIGGRAPH 1982. Divides the group with the largest range in a channel at the middle of that
/// range, until there are `most` groups or all colours of each group are equal.
ColourGroups group_colours(std::span<const Colour> colours, std::size_t most);

}  // namespace cascade
