// The frame of a crawling cell, as formulas of its quaternion (internal to the checker).
//
// The quaternion q = (w, x, y, z) rotates the axes of space into the axes of the cell. The length
// of q has no meaning, because axes are computed from q / |q|.
#pragma once

#include "lang/program/program.h"

#include <array>

namespace cascade::checking {

/// The rates of the four components of q: q' = ½ ω q + (1 − |q|²) q. The vector `spin` is the
/// angular velocity ω in the axes of space. The second term keeps |q| near 1 and does not rotate
/// the frame.
std::array<Formula, 4> rates_of_frame(ItemId frame, DefinitionId spin);

/// The four components of q at the start, with |q| = 1. The y axis has the direction of the vector
/// `ey` or, if `ey` is empty, of the normal. The z axis has the direction of the part of `ez` that
/// is perpendicular to the y axis. If `ez` is empty, a random direction takes its place. If ez is
/// parallel to ey, the z axis is a direction perpendicular to ey that depends only on ey.
std::array<Formula, 4> starting_frame(const Formula& ey, const Formula& ez);

}  // namespace cascade::checking
