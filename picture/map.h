// Maps: one small picture for each pair of two numbers, with the numbers along the axes.
#pragma once

#include "picture/image.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// What runs along a side of a map. An axis without a name has one value and no labels.
struct MapAxis {
    std::string name;
    std::vector<std::string> values;
};

/// One place of a map. Without an image it is left empty, with its remark in it.
struct MapTile {
    Image image;
    std::string remark;
};

/// Tiles in rows, the lowest first: as in a diagram, `up` grows upwards. There is one for every
/// pair of values, tile row · across.values.size() + column. All images are enlarged by one whole
/// factor, so that small ones can be seen; a picture of a few rows is drawn as a band.
Image make_map(std::span<const MapTile> tiles, const MapAxis& across, const MapAxis& up);

}  // namespace cascade
