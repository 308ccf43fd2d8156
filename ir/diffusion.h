// The diffusion terms of a species, for solvers that take them implicitly.
#pragma once

#include <array>
#include <cstddef>

namespace cascade {

/// The number of factors: of lap, lap(lap), … and then of dxx, dyy, dzz.
inline constexpr std::size_t laplacian_powers = 4;
inline constexpr std::size_t diffusion_terms = laplacian_powers + 3;

/// The factors, ordered as above. Those of even powers of lap are negated, because lap changes the
/// sign of a wave: so in every term a positive factor damps, and a larger one damps more.
template <typename Factor>
using DiffusionTerms = std::array<Factor, diffusion_terms>;

}  // namespace cascade
