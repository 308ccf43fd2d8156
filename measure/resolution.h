// Has a pattern enough cells for its waves?
#pragma once

#include "measure/samples.h"

namespace cascade::measure {

/// Shorter waves are made by the grid as much as by the equations: along an axis the Laplacian of
/// differences takes less than 0.81 = 2 (1 − cos(2π/4)) / (2π/4)² of the square of their wave
/// number, and more of it along a diagonal.
inline constexpr double fewest_cells_a_wave = 4;

/// The wavelength in cells of a field whose waves have fewer than `fewest_cells_a_wave`, but more
/// than the two of a chequerboard; NaN for all other fields, and for those that have no wavelength
/// to speak of, such as noise. Costs a Fourier transform only where neighbours differ so much that
/// it may be so.
double unresolved_wavelength(const Samples& samples);

/// The part of a field's variance that is in waves of fewer than `fewest_cells_a_wave` cells, 0 …
/// 1: in a plane 1 − π/16 = 0.80 of white noise. 0 where it is known to be small without a Fourier
/// transform.
double unresolved_part(const Samples& samples);

}  // namespace cascade::measure
