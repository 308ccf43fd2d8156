// The diffusion terms of a species, for solvers that take them implicitly.
#pragma once

#include <array>
#include <cstddef>

namespace cascade {

/// The number of factors: for lap, lap(lap), …, then for dxx, dyy, dzz, then for dxy, and the rate
/// of decay.
inline constexpr std::size_t laplacian_powers = 4;
inline constexpr std::size_t mixed_term = laplacian_powers + 3;
inline constexpr std::size_t decay_term = mixed_term + 1;
inline constexpr std::size_t diffusion_terms = decay_term + 1;

/// The factors, ordered as above. Factors of even powers of lap are negated, because lap changes
/// the sign of a wave. So in every term a positive factor damps, and a larger one damps more. The
/// factor of dxy has either sign, and is 0 unless the grid is periodic along x and y.
template <typename Factor>
using DiffusionTerms = std::array<Factor, diffusion_terms>;

}  // namespace cascade
