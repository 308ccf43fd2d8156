// Checks whether a grid resolves the waves of a pattern.
#pragma once

#include "measure/samples.h"

namespace cascade::measure {

/// The wavelength, in cells, below which the grid distorts waves. Along an axis, the discrete
/// Laplacian of a shorter wave is less than 0.81 = 2 (1 − cos(2π/4)) / (2π/4)² times the exact
/// value. Along a diagonal the factor is larger.
inline constexpr double fewest_cells_a_wave = 4;

/// The wavelength of a field in cells, if it is below `fewest_cells_a_wave` but above 2 (the
/// wavelength of a chequerboard). NaN for any other field, including fields without a wavelength,
/// such as noise. Uses a Fourier transform only if neighbours are weakly correlated.
double unresolved_wavelength(const Samples& samples);

/// The fraction, 0 … 1, of a field's variance that belongs to waves shorter than
/// `fewest_cells_a_wave` cells. For white noise in a plane it is 1 − π/16 = 0.80. Returns 0 if the
/// correlation of neighbours already shows that the fraction is small.
double unresolved_part(const Samples& samples);

}  // namespace cascade::measure
