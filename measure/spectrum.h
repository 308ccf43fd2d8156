// The wavelength of a pattern, from its power spectrum.
#pragma once

#include "measure/samples.h"

#include <vector>

namespace cascade::measure {

/// The variance of a field, split by wave number.
struct Spectrum {
    double ring_width = 0;       ///< Waves per unit of length from a ring to the next: 1 / longest
                                 ///< side (half of it where that side is mirrored).
    std::vector<double> power;   ///< Of ring n, |k| nearest to n · ring_width: its part of the
                                 ///< variance. Their sum is the variance.
    std::vector<double> moment;  ///< Σ power · |k| of ring n.
};

/// Along a periodic axis the discrete Fourier transform; along one that is mirrored at its sides
/// the cosine transform (DCT-II), whose waves fit such a domain. The mean is taken away first.
/// Each mode's share of the variance is exact (Parseval's theorem).
Spectrum radial_spectrum(const Samples& samples);

/// The wavelength at the spectrum's peak, in the unit of lengths: one over the power-weighted mean
/// of |k| over the rings from 1/1.3 to 1.3 times the strongest one, which leaves out the other
/// waves of a lattice (√2 of a square one, √3 of a hexagonal one). NaN where nothing varies.
double peak_wavelength(const Spectrum& spectrum);

/// The part of the variance that those rings have, 0 … 1: near 1 for one regular wave.
double peak_share(const Spectrum& spectrum);

}  // namespace cascade::measure
