// Filters planes wave by wave, for solvers that take diffusion implicitly.
//
// Each plane is transformed into waves (solvers/wave_transforms.h), each wave is multiplied by a
// factor, and the result is transformed back.
#pragma once

#include "core/parallel.h"
#include "core/side.h"
#include "ir/diffusion.h"
#include "ir/sweep_form.h"
#include "solvers/wave_transforms.h"

#include <span>
#include <vector>

namespace cascade {

/// The diffusion of one species. A wave for which lap is s and dxx, dyy, dzz are s_x, s_y, s_z (all
/// of them 0 or less) changes at the rate
///     M = min(0, f[0] s − f[1] s² + f[2] s³ − f[3] s⁴ + f[4] s_x + f[5] s_y + f[6] s_z).
/// Waves that the factors would make grow are thus left to the explicit part of the step.
using DiffusionSymbol = DiffusionTerms<double>;

template <typename Number>
class WaveFilter {
public:
    /// `sides` are by species. Throws std::bad_alloc.
    WaveFilter(const Grid& grid, const std::vector<SideRules>& sides) : transforms_(grid, sides) {}

    /// Multiplies every wave of every plane by its response. Planes are given by the addresses of
    /// their cells (0, 0, 0), one for each species. `length` is the h of the response. Called by
    /// the first `threads` threads of the team, as WaveTransforms::apply().
    void apply(Team& team, int thread, int threads, std::span<Number* const> planes,
               std::span<const DiffusionSymbol> symbols, WaveResponse response,
               double length) const;

private:
    WaveTransforms<Number> transforms_;
};

extern template class WaveFilter<float>;
extern template class WaveFilter<double>;

}  // namespace cascade
