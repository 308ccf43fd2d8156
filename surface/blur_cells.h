// Values of cells blurred by diffusion: G. Turk, "Texturing Surfaces Using Reaction-Diffusion"
// (thesis, 1992), section 5.4.2. Diffusing for a time t is averaging with a Gaussian whose standard
// deviation is σ = √(2 t) along each direction.
#pragma once

#include "surface/voronoi_cells.h"

#include <span>
#include <vector>

namespace cascade {

/// √(area / cells): what σ is measured in.
double cell_spacing(const SurfaceCells& cells);

/// Blurs `values`, `channels` numbers a cell, cell after cell, from a standard deviation of 0 to
/// `sigma`, at least 0, in cell spacings. The sum of value times area stays but for rounding, and no
/// value leaves the range of those there were. Cells much smaller than the others count as a fifth of
/// the average. The same on any number of threads.
///
/// One or several steps of the first-order Runge-Kutta-Legendre method of C. Meyer, D. Balsara and
/// T. Aslam, "A stabilized Runge-Kutta-Legendre method for explicit super-time-stepping of parabolic
/// and mixed equations", Journal of Computational Physics 257, 2014, section 2: s sweeps go as
/// far as (s² + s) / 2 steps of forward Euler.
void blur_cells(const SurfaceCells& cells, double sigma, int channels, std::vector<float>& values,
                Team& team);

}  // namespace cascade
