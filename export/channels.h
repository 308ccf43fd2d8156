// Results on a surface as files store them: named numbers, and colours.
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

/// The names of the channels, with underscores added where a name equals another one or one of
/// `reserved`.
std::vector<std::string> distinct_names(std::span<const Channel> channels,
                                        std::initializer_list<std::string_view> reserved);

/// The colour with its channels clamped to 0 … 1, or the colour that represents NaN if a channel is
/// NaN.
Colour shown(const Colour& colour);

/// Whether every coordinate of the points is 0 or in the normal range of binary32.
bool are_single(std::span<const Vector3d> points);

}  // namespace cascade
