// Numbers that describe a pattern: spots, area, wavelength, direction.
//
// All functions take a picture of width × height values, row by row, on a periodic plane.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace cascade {

struct Pattern2d {
    std::size_t width = 1;
    std::size_t height = 1;
    std::vector<double> values;
};

using Predicate = std::function<bool(double)>;

/// The fraction of cells whose value fulfils the predicate, 0 … 1.
double area_fraction(const Pattern2d& pattern, const Predicate& predicate);

/// The number of connected regions of at least `smallest` cells whose values fulfil the predicate.
/// Cells that share a side are connected, also across the periodic borders.
std::size_t count_regions(const Pattern2d& pattern, const Predicate& predicate,
                          std::size_t smallest = 1);

/// Mean and standard deviation over the cells.
struct Moments {
    double mean = 0;
    double deviation = 0;
};
Moments moments(const Pattern2d& pattern);

/// Correlation coefficient of two pictures of one size, −1 … 1.
double correlation(const Pattern2d& a, const Pattern2d& b);

/// Properties of the power spectrum |DFT|² of the picture without its mean.
struct SpectrumSummary {
    /// The wavelength in cells at the centre of the spectrum's peak. Power is summed over rings of
    /// the integer wave number round(|k|), with k in waves per `width`. The centre is the
    /// power-weighted mean of |k| over the rings from 0.5 to 1.5 times the strongest ring.
    double peak_wavelength = 0;
    /// The wavelength in cells that belongs to the power-weighted mean of |k| over all rings.
    double mean_wavelength = 0;
    /// |Σ P e^(2iθ)| / Σ P with θ the direction of k: 0 for no preferred direction, 1 for straight
    /// parallel stripes.
    double anisotropy = 0;
};
/// The picture must be square or have one row.
SpectrumSummary summarise_spectrum(const Pattern2d& pattern);

}  // namespace cascade
