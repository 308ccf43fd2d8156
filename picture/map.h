// Maps: a small picture for each pair of two parameters, with their values along the axes.
#pragma once

#include "picture/image.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// An axis of a map. An axis without a name has one value and no labels.
struct MapAxis {
    std::string name;
    std::vector<std::string> values;
};

/// A cell of a map. Without an image, only the remark is drawn in it.
struct MapTile {
    Image image;
    std::string remark;
};

/// A map of tiles in rows, the lowest first: as in a diagram, `up` increases upwards. The tile for
/// a pair of values is row · across.values.size() + column. All images are enlarged by a common
/// integral factor so that small ones are visible. A picture of a few rows is drawn as a band.
Image make_map(std::span<const MapTile> tiles, const MapAxis& across, const MapAxis& up);

}  // namespace cascade
