// The format in which maps store heights and directions (internal to export/).
#pragma once

#include "core/vector3.h"
#include "picture/image.h"

#include <algorithm>
#include <span>

namespace cascade {

/// Stores heights as greys, from black at the lower end of the range to white at the upper end. If
/// both ends are equal, stores ½.
inline void store_heights(ValueRange range, std::span<Colour> texels) {
    const double low = static_cast<double>(range.low);
    const double width = static_cast<double>(range.high) - low;
    for (Colour& texel : texels) {
        const double part = width > 0 ? (static_cast<double>(texel[0]) - low) / width : 0.5;
        texel.fill(static_cast<float>(std::clamp(part, 0.0, 1.0)));
    }
}

/// A direction of length 1 as a colour. Components from −1 to 1 are stored as 0 to 1.
inline Colour stored_direction(const Vector3& direction) {
    const auto stored = [](float part) { return std::clamp(0.5F + 0.5F * part, 0.0F, 1.0F); };
    return {stored(direction.x), stored(direction.y), stored(direction.z)};
}

}  // namespace cascade
