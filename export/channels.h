// What grew on a surface, as files take it: numbers with names, and colours.
#pragma once

#include "core/palette.h"
#include "mesh/surface_mesh.h"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Numbers with a name, one for each point of a mesh, or one for each cell.
using Channel = PointAttribute;

/// The names of the channels, no two of them alike and none of them `reserved`: underscores are
/// added until that is so.
std::vector<std::string> distinct_names(std::span<const Channel> channels,
                                        std::initializer_list<std::string_view> reserved);

/// The colour, clamped to 0 … 1, or that of NaN where a channel of it is none.
Colour shown(const Colour& colour);

/// Whether every coordinate of the points is 0 or a normal number of binary32.
bool are_single(std::span<const Vector3d> points);

}  // namespace cascade
