// The wavelength of a pattern, from its power spectrum.
#pragma once

#include "measure/samples.h"

#include <vector>

namespace cascade::measure {

/// The variance of a field, split by wave number.
struct Spectrum {
    double ring_width = 0;       ///< Difference of wave numbers between adjacent rings: 1 / longest
                                 ///< side, or half of it if that side is mirrored.
    std::vector<double> power;   ///< The part of the variance in ring n, whose |k| are nearest to n
                                 ///< · ring_width. The sum is the variance.
    std::vector<double> moment;  ///< Σ power · |k| in ring n.
};

/// Subtracts the mean, then uses the discrete Fourier transform along periodic axes and the cosine
/// transform (DCT-II), whose waves fit such a domain, along mirrored ones. Each mode's share of the
/// variance is exact (Parseval's theorem).
Spectrum radial_spectrum(const Samples& samples);

/// The wavelength at the spectrum's peak, in the unit of length: the inverse of the power-weighted
/// mean of |k| over the rings from 1/1.3 to 1.3 times the strongest one, which excludes the other
/// waves of a lattice (√2 for a square one, √3 for a hexagonal one). NaN for a uniform field.
double peak_wavelength(const Spectrum& spectrum);

/// The spectrum in wider rings, so that about twelve lie below the strongest one. In a large domain
/// rings are narrow, and chance decides which ring of a broad peak is the strongest.
Spectrum in_wide_rings(const Spectrum& spectrum);

/// The fraction of the variance in the peak's rings, 0 … 1: near 1 for one regular wave.
double peak_share(const Spectrum& spectrum);

}  // namespace cascade::measure
