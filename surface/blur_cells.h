// Blurs cell values by diffusion: G. Turk, "Texturing Surfaces Using Reaction-Diffusion" (thesis,
// 1992), section 5.4.2. Diffusion for a time t convolves with a Gaussian of σ = √(2 t).
#pragma once

#include "surface/voronoi_cells.h"

#include <span>
#include <vector>

namespace cascade {

/// √(area / number of cells), the unit of σ.
double cell_spacing(const SurfaceCells& cells);

/// Blurs `values` (`channels` numbers per cell, cell after cell) by a Gaussian with standard
/// deviation `sigma`, 0 … 10⁴, in cell spacings. Preserves the sum of value times area up to
/// rounding. Values exceed their original range by at most a thousandth of the range. A cell
/// smaller than a fifth of the average area counts as if it had that fifth. The result is the same
/// with any number of threads.
///
/// Computes the exponential of diffusion by Chebyshev polynomials of the flows between neighbours
/// (H. Tal-Ezer and R. Kosloff, "An accurate and efficient scheme for propagating the time
/// dependent Schrödinger equation", Journal of Chemical Physics 81, 1984, in imaginary time).
/// Applies the flows about 15 × `sigma` times.
void blur_cells(const SurfaceCells& cells, double sigma, int channels, std::vector<float>& values,
                Team& team);

}  // namespace cascade
