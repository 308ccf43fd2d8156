// Computes bands and borders. Each level removes one layer from each end of an upright part.
#include "solvers/tile_shape.h"

#include "core/parallel.h"

#include <algorithm>
#include <limits>

namespace cascade {

TileAxis::TileAxis(std::int64_t layers, int bands, bool wraps)
    : layers_(layers),
      bands_(
          static_cast<int>(std::clamp<std::int64_t>(bands, 1, std::max<std::int64_t>(layers, 1)))),
      wraps_(wraps) {}

std::int64_t TileAxis::begin_of(int band) const {
    return band == bands_ ? layers_ : split_rows(layers_, band, bands_).begin;
}

int TileAxis::most_levels() const {
    std::int64_t most = std::numeric_limits<int>::max();
    if (borders() > 0) most = layers_ / bands_ / 2 + 1;  // All bands are at least this wide.
    return static_cast<int>(most);
}

LayerRange TileAxis::upright(int band, int level) const {
    const bool is_first = !wraps_ && band == 0, is_last = !wraps_ && band == bands_ - 1;
    return {begin_of(band) + (is_first ? 0 : level), begin_of(band + 1) - (is_last ? 0 : level)};
}

LayerRange TileAxis::inverted(int border, int level) const {
    const std::int64_t at = begin_of(border + 1);
    return {at - level, at + level};
}

}  // namespace cascade
