// Pictures of planes and slices whose domain grows, in the proportions of the present moment.
#pragma once

#include "picture/image.h"
#include "run/script/picture_request.h"
#include "run/simulation/simulation.h"

#include <array>

namespace cascade {

/// The lengths of a cell of the shown stage, across and down a plane or slice, divided by the
/// spacing of the grid.
using PlaneScales = std::array<double, 2>;
PlaneScales scales_of_plane(const Simulation& simulation, const Slice& slice);

/// The same number twice for a surface, a model or a body, whose domain grows alike in all
/// directions: the length of a cell, divided by its length without growth.
PlaneScales scales_of_body(const Simulation& simulation);

/// The image of a plane with square cells, made longer along the axis along which cells are longer.
Image in_proportion(Image image, const PlaneScales& scales);

/// The image of in_proportion() as a part of a picture of the domain at its largest: the picture
/// has the size of an image with the scales `largest`, and the domain is in its middle.
Image in_largest(const Image& image, const PlaneScales& scales, const PlaneScales& largest);

}  // namespace cascade
