// The frame of a cell that crawls as formulas of its quaternion (internal to the checker).
//
// The quaternion q = (w, x, y, z) turns the axes of space into those of the cell. Its length has no
// meaning: the axes are computed from q / |q|.
#pragma once

#include "lang/program/program.h"

#include <array>

namespace cascade::checking {

/// The rates of the four components, q' = ½ ω q + (1 − |q|²) q, where the vector `spin` is the
/// angular velocity ω in the axes of space. The second term keeps |q| near 1 and does not turn.
std::array<Formula, 4> rates_of_frame(ItemId frame, DefinitionId spin);

/// The four components at the start, of length 1: the y axis has the direction of the vector `ey`
/// (empty: the normal), and the z axis the direction of `ez` as far as it is across ey (empty: at
/// random). Where ez is along ey the z axis is a direction across ey that depends on ey alone.
std::array<Formula, 4> starting_frame(const Formula& ey, const Formula& ez);

}  // namespace cascade::checking
