// The dispersion relation of a flat state: the growth rate of a small wave by its length.
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
    double phase = 0;  ///< From one cell to the next along its direction, in radians. 0: all cells
                       ///< change alike.
    Complex rate;      ///< The wave grows as exp(Re rate · t) and turns by Im rate · t.

    double cells() const;  ///< The wavelength in cells. Infinite at phase 0.
};

/// Whether a rate has an imaginary part beyond rounding.
bool oscillates(Complex rate, double resolution);

/// An interval of wavelengths, all of which grow.
struct GrowingBand {
    double least = 0, most = 0;  ///< Their phases. A band may begin at 0 or end at the shortest
                                 ///< wave of the grid.
};

/// The response of a flat state to a small change.
enum class Stability : std::uint8_t {
    stable,   ///< The change fades, or at least does not grow.
    turing,   ///< Standing waves of some lengths grow, but a uniform change does not.
    wave,     ///< The same for travelling or oscillating waves.
    hopf,     ///< A uniform oscillation grows.
    both,     ///< An oscillation as in `hopf`, and standing waves that grow faster.
    uniform,  ///< A uniform change grows: all cells leave the state together.
};

/// A curve of the relation along one direction.
struct Branch {
    std::vector<double> phases;
    std::vector<Complex> largest;  ///< The eigenvalue with the largest real part.
    std::vector<Complex> second;   ///< The next one that is not its conjugate. NaN without one.
};

struct Dispersion {
    Stability stability = Stability::stable;
    Complex at_rest;                 ///< The largest rate of a uniform change.
    GrowingWave fastest;             ///< The fastest of all other waves.
    std::vector<GrowingBand> bands;  ///< Along its direction, long waves first.
    Branch curve;                    ///< Along its direction.
    bool depends_on_direction = false;
    /// Rates of smaller magnitude are rounding errors of 0.
    double resolution = 0;

    bool grows_at_rest() const { return at_rest.real() > resolution; }
    bool has_growing_waves() const { return fastest.rate.real() > resolution; }
};

/// The eigenvalues of a wave, by decreasing real part.
std::vector<Complex> eigenvalues(const LinearModel& model, const Matrices& matrices,
                                 const Lattice& lattice, const Phases& phases);

/// The relation of a state with these matrices. Waves shorter than two cells do not exist. On a
/// model, they end at two mean distances of neighbours.
Dispersion dispersion(const LinearModel& model, const Matrices& matrices);

/// dispersion() without its curve and bands, in a tenth of the time. Sets only the wave and the
/// rate of `fastest`.
Dispersion quick_dispersion(const LinearModel& model, const Matrices& matrices);

/// The fastest non-uniform wave that fits the domain. Empty if its size is unknown.
std::optional<GrowingWave> fastest_fitting_wave(const LinearModel& model, const Matrices& matrices);

/// The eigenvalues that do not grow, of all waves that fit the cells, for stable steps.
std::vector<Complex> decaying_rates(const LinearModel& model, const Matrices& matrices);

}  // namespace cascade::analysis
