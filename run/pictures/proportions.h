// Pictures of planes and slices in a domain that grows, with the proportions that the domain has at
// the present moment.
#pragma once

#include "picture/image.h"
#include "run/script/picture_request.h"
#include "run/simulation/simulation.h"

#include <array>

namespace cascade {

/// The lengths of a cell of the shown stage, to the right and downwards in a plane or slice,
/// divided by the spacing of the grid.
using PlaneScales = std::array<double, 2>;
PlaneScales scales_of_plane(const Simulation& simulation, const Slice& slice);

/// The same number twice for a surface, a model or a body, whose domain grows alike in all
/// directions: the length of a cell, divided by its length without growth.
PlaneScales scales_of_body(const Simulation& simulation);

/// The image of a plane with square cells, made longer along the axis along which cells are longer.
Image in_proportion(Image image, const PlaneScales& scales);

/// Puts the image of in_proportion() into a picture of the domain at its largest. The picture has
/// the size of an image with the scales `largest`, and the domain is in its middle.
Image in_largest(const Image& image, const PlaneScales& scales, const PlaneScales& largest);

}  // namespace cascade
