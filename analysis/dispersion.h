// The dispersion relation of a flat state: how fast small waves grow, depending on their length.
#pragma once

#include "analysis/local_rates.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade::analysis {

/// A direction of waves, of length 1.
using Direction = std::array<double, 3>;

/// A wave and its growth.
struct GrowingWave {
    Direction direction{1, 0, 0};
    /// The phase from one cell to the next along `direction`, in radians. At phase 0 all cells
    /// change alike.
    double phase = 0;
    Complex rate;  ///< The wave grows by exp(Re rate · t) and turns by Im rate · t.

    double cells() const;  ///< The wavelength in cells. Infinite at phase 0.
};

/// Whether the imaginary part of a rate is larger than rounding errors.
bool oscillates(Complex rate, double resolution);

/// An interval of wavelengths in which all waves grow.
struct GrowingBand {
    /// The phases at the ends of the interval, which may begin at 0 or end at the shortest wave of
    /// the grid.
    double least = 0, most = 0;
};

/// The behaviour of a flat state after a small change.
enum class Stability : std::uint8_t {
    stable,  ///< The change fades, or at least does not grow.
    turing,  ///< Standing waves of some lengths grow, but a uniform change does not.
    wave,  ///< Travelling or oscillating waves of some lengths grow, but a uniform change does not.
    hopf,  ///< A uniform oscillation grows.
    both,  ///< A uniform oscillation grows, and standing waves grow faster.
    uniform,  ///< A uniform change grows: all cells leave the state together.
};

/// The rates of waves along one direction.
struct Branch {
    std::vector<double> phases;
    std::vector<Complex> largest;  ///< The eigenvalue with the largest real part.
    /// The next eigenvalue that is not the conjugate of the largest; NaN if there is none.
    std::vector<Complex> second;
};

struct Dispersion {
    Stability stability = Stability::stable;
    Complex at_rest;      ///< The largest rate of a uniform change.
    GrowingWave fastest;  ///< The fastest of all waves that are not uniform.
    /// The bands along the direction of `fastest`, long waves first.
    std::vector<GrowingBand> bands;
    Branch curve;  ///< The rates along the direction of `fastest`.
    bool depends_on_direction = false;
    /// Rates of smaller magnitude are only rounding errors and count as 0.
    double resolution = 0;

    bool grows_at_rest() const { return at_rest.real() > resolution; }
    bool has_growing_waves() const { return fastest.rate.real() > resolution; }
};

/// The eigenvalues of a wave, by decreasing real part.
std::vector<Complex> eigenvalues(const LinearModel& model, const Matrices& matrices,
                                 const Lattice& lattice, const Phases& phases);

/// The dispersion relation of a state with these matrices. No wave is shorter than two cells. On a
/// model, the shortest wavelength is twice the mean distance between neighbours.
Dispersion dispersion(const LinearModel& model, const Matrices& matrices);

/// Does the same as dispersion(), but computes neither the curve nor the bands. Samples fewer
/// waves, and takes a tenth of the time.
Dispersion quick_dispersion(const LinearModel& model, const Matrices& matrices);

/// The fastest non-uniform wave that fits into the domain. Empty if the domain's size is unknown.
std::optional<GrowingWave> fastest_fitting_wave(const LinearModel& model, const Matrices& matrices);

/// The rates of all waves that fit into the cells and do not grow. Serves to find stable steps.
std::vector<Complex> decaying_rates(const LinearModel& model, const Matrices& matrices);

}  // namespace cascade::analysis
