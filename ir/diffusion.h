// What the diffusion of a species is made of, for solvers that take it implicitly.
#pragma once

#include <array>
#include <cstddef>

namespace cascade {

/// Factors of lap, lap(lap), … and then of dxx, dyy, dzz.
inline constexpr std::size_t laplacian_powers = 4;
inline constexpr std::size_t diffusion_terms = laplacian_powers + 3;

/// The factors, from the left as above. Those of even powers of lap have the other sign: lap turns
/// a wave over, so that of all terms a factor above 0 damps and a larger one damps more.
template <typename Factor>
using DiffusionTerms = std::array<Factor, diffusion_terms>;

}  // namespace cascade
