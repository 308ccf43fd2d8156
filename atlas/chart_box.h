// The bounding rectangle of a flat chart.
#pragma once

#include "atlas/chart.h"

#include <algorithm>
#include <limits>

namespace cascade {

/// A rectangle parallel to the axes.
struct FlatBox {
    Vector2d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vector2d high{low.x * -1, low.y * -1};

    void add(Vector2d p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    Vector2d size() const { return high - low; }
};

/// The smallest rectangle, of any direction, around a chart.
struct TurnedBox {
    /// The rotation, of length 1, that makes the rectangle's sides parallel to the axes.
    Vector2d turn{1, 0};
    Vector2d size;  ///< The size after rotation.
};
TurnedBox smallest_box(const Chart& chart);

}  // namespace cascade
