// Finds the wavelength of a pattern from its power spectrum.
#pragma once

#include "measure/samples.h"

#include <vector>

namespace cascade::measure {

/// The variance of a field, divided among rings, that is, among ranges of wave numbers |k|.
struct Spectrum {
    /// The difference between the wave numbers of adjacent rings: 1 / (longest side), or half of
    /// that if the longest side is mirrored.
    double ring_width = 0;
    /// power[n] is the part of the variance in ring n. This ring has the modes whose |k| is nearer
    /// to n · ring_width than to any other multiple of ring_width. The sum of all parts is the
    /// variance.
    std::vector<double> power;
    std::vector<double> moment;  ///< moment[n] is Σ power · |k| over the modes of ring n.
    std::vector<double> modes;   ///< The number of modes in ring n.
};

/// Subtracts the mean. Then uses the discrete Fourier transform along periodic axes, and the cosine
/// transform (DCT-II) along axes with mirrored sides. The part of the variance in each mode is
/// exact (Parseval's theorem).
Spectrum radial_spectrum(const Samples& samples);

/// The wavelength at the peak of the spectrum, in the unit of length. It is the inverse of the mean
/// of |k|, weighted by power. The mean is taken over the rings from 1/1.3 to 1.3 times the |k| of
/// the strongest ring. This range excludes other waves of a regular pattern, which are shorter by
/// √2 (square) or √3 (hexagonal). NaN for a uniform field.
double peak_wavelength(const Spectrum& spectrum);

/// The spectrum in wider rings, about twelve of which are below the strongest one. In a large
/// domain rings are so narrow that chance decides which ring of a broad peak is the strongest.
Spectrum in_wide_rings(const Spectrum& spectrum);

/// The characteristic length of a coarsening pattern, Σ S / Σ |k| S, in the unit of length. The
/// sums run over all rings, and S is the structure factor averaged over a ring: its power divided
/// by its number of modes. This is 2π divided by the first moment of S(q), where q = 2π |k| (J.
/// Zhu, L.-Q. Chen, J. Shen and V. Tikare, "Coarsening kinetics from a variable-mobility
/// Cahn-Hilliard equation", Physical Review E 60, 1999). Averages over rings, unlike sums over
/// modes, depend little on the width of interfaces. NaN for a uniform field.
double first_moment_length(const Spectrum& spectrum);

/// The fraction of the variance in the rings over which peak_wavelength() takes the mean, 0 … 1.
/// Near 1 for a single regular wave.
double peak_share(const Spectrum& spectrum);

}  // namespace cascade::measure
