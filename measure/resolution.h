// Checks whether a grid resolves the waves of a pattern.
#pragma once

#include "measure/samples.h"

namespace cascade::measure {

/// Shorter waves are distorted by the grid: along an axis, the discrete Laplacian gives less than
/// 0.81 = 2 (1 − cos(2π/4)) / (2π/4)² of the square of their wave number; along a diagonal more.
inline constexpr double fewest_cells_a_wave = 4;

/// The wavelength in cells of a field whose waves have fewer than `fewest_cells_a_wave` cells, but
/// more than the two of a chequerboard. NaN for all other fields, including fields without a
/// wavelength, such as noise. Needs a Fourier transform only if neighbours are weakly correlated.
double unresolved_wavelength(const Samples& samples);

/// The fraction of a field's variance in waves of fewer than `fewest_cells_a_wave` cells, 0 … 1: in
/// a plane of white noise 1 − π/16 = 0.80. 0 if correlations already show that it is small.
double unresolved_part(const Samples& samples);

}  // namespace cascade::measure
