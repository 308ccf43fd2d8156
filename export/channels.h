// The results on a surface for files: named numbers, and colours.
#pragma once

#include "core/palette.h"
#include "mesh/surface_mesh.h"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Named numbers, one for each point of a mesh, or one for each cell.
using Channel = PointAttribute;

/// The names of the channels, made distinct from each other and from `reserved` by underscores.
std::vector<std::string> distinct_names(std::span<const Channel> channels,
                                        std::initializer_list<std::string_view> reserved);

/// The colour, clamped to 0 … 1, or the colour of NaN if one of its channels is NaN.
Colour shown(const Colour& colour);

/// Whether every coordinate of the points is 0 or a normal binary32 number.
bool are_single(std::span<const Vector3d> points);

}  // namespace cascade
