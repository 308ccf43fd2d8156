// The diffusion terms of a species, for solvers that treat them implicitly.
#pragma once

#include <array>
#include <cstddef>

namespace cascade {

/// The number of powers of the Laplacian among the terms. The terms are, in this order: the powers
/// lap, lap(lap), …; dxx, dyy, dzz; dxy; the rate of decay.
inline constexpr std::size_t laplacian_powers = 4;
inline constexpr std::size_t mixed_term = laplacian_powers + 3;
inline constexpr std::size_t decay_term = mixed_term + 1;
inline constexpr std::size_t diffusion_terms = decay_term + 1;

/// One factor for each term, in the order stated above. Each lap changes the sign of a wave, so
/// factors of even powers of lap are stored negated. As a result, in every term a positive factor
/// damps waves, and a larger factor damps them more. Only the factor of dxy may have either sign,
/// and it is 0 unless the grid is periodic along x and y.
template <typename Factor>
using DiffusionTerms = std::array<Factor, diffusion_terms>;

}  // namespace cascade
