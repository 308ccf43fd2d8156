// For comparison: a loop over cells and their neighbours as one would write it by hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cascade::bench {

/// Planes with one number per cell: position, radius and an axis, and the rates of the position and
/// of the axis.
struct StraightTissue {
    std::span<const std::size_t> ends;
    std::span<const std::uint32_t> neighbours;
    const float *x, *y, *z, *radius, *axis_x, *axis_y, *axis_z;
    float *to_x, *to_y, *to_z, *turn_x, *turn_y, *turn_z;
};

inline constexpr float bench_push = 0.5F, bench_stick = 0.05F, bench_reach = 1.2F;

/// Collision, adhesion and combing. Cells push each other where they overlap, attract each other up
/// to the reach, and turn their axes towards the axes of the cells that they touch.
void straight_rates(const StraightTissue& tissue);

}  // namespace cascade::bench
