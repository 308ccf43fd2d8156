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

/// Blurs `values`, `channels` numbers a cell, cell after cell, by a Gaussian with the standard
/// deviation `sigma`, 0 … 10⁴, in cell spacings. The sum of value times area stays but for
/// rounding, and values leave the range of those there were by a thousandth of it at most. Cells
/// much smaller than the others count as a fifth of the average. The same on any number of threads.
///
/// The exponential of diffusion by Chebyshev polynomials of the flows between neighbours (H.
/// Tal-Ezer and R. Kosloff, "An accurate and efficient scheme for propagating the time dependent
/// Schrödinger equation", Journal of Chemical Physics 81, 1984, in imaginary time): about 15 sigma
/// sweeps.
void blur_cells(const SurfaceCells& cells, double sigma, int channels, std::vector<float>& values,
                Team& team);

}  // namespace cascade
