// The damping of waves by diffusion (internal to solvers/).
#pragma once

#include "ir/diffusion.h"
#include "solvers/wave_transforms.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cascade {

/// The diffusion of one species. The operators multiply a wave by factors: lap by s, dxx, dyy and
/// dzz by s_x, s_y and s_z (all of these are at most 0), and dxy by m. The wave then changes at the
/// rate
///
///     M = min(0, f[0] s − f[1] s² + f[2] s³ − f[3] s⁴ + f[4] s_x + f[5] s_y + f[6] s_z + f[7] m
///                − f[8]).
///
/// Because M is at most 0, waves that diffusion would amplify are left to the explicit part of the
/// step.
using DiffusionSymbol = DiffusionTerms<double>;

/// Computes −h M for every wave of a line. `f` is the symbol times h.
template <typename Number>
void find_damping(const WaveBlock<Number>& block, std::int64_t line,
                  const DiffusionTerms<Number>& f, std::vector<Number>& found) {
    const Number* const along = block.differences[block.axis];
    Number q_of_rest = 0, of_rest = -f[decay_term];
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (axis == block.axis) continue;
        const Number difference = block.differences[axis][axis == 0 ? line : 0];
        q_of_rest -= difference;
        of_rest += f[laplacian_powers + axis] * difference;
    }
    const Number of_axis = f[laplacian_powers + block.axis];
    found.resize(static_cast<std::size_t>(block.count));
    Number* const damping = found.data();
    for (std::int64_t n = 0; n < block.count; ++n) {
        const Number q = q_of_rest - along[n];
        const Number of_axes = of_axis * along[n] + of_rest;
        const Number change = of_axes - q * (f[0] + q * (f[1] + q * (f[2] + q * f[3])));
        damping[n] = -change;
    }
    if (f[mixed_term] != 0 && block.axis > 0) {
        const Number across = f[mixed_term] * block.slopes[0][line];
        const Number* const slopes = block.slopes[1];
        for (std::int64_t n = 0; n < block.count; ++n) {
            damping[n] += across * slopes[block.axis == 1 ? n : 0];
        }
    }
    for (std::int64_t n = 0; n < block.count; ++n) damping[n] = std::max(damping[n], Number{0});
}

}  // namespace cascade
