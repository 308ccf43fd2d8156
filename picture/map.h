// A map shows a small picture for each pair of values of two parameters. The values are written
// along the axes.
#pragma once

#include "picture/image.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// An axis of a map. An axis without a name must have one value, and gets no labels.
struct MapAxis {
    std::string name;
    std::vector<std::string> values;
};

/// One of the small pictures in a map. If there is no image, the remark is drawn in its place.
struct MapTile {
    Image image;
    std::string remark;
};

/// Draws a map of tiles. The rows begin at the bottom, so that the values of `up` increase upwards.
/// The tile for a pair of values has the index row · across.values.size() + column. All pictures
/// are enlarged by the same integer, so that small pictures are legible. A picture with only a few
/// rows is stretched to a band.
Image make_map(std::span<const MapTile> tiles, const MapAxis& across, const MapAxis& up);

}  // namespace cascade
