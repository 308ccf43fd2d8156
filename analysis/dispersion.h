// The dispersion relation of a flat state: how fast a small wave grows, by its length.
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
    double phase = 0;  ///< From one cell to the next along its direction, in radians; 0: all cells
                       ///< change alike.
    Complex rate;      ///< The wave grows as exp(Re rate · t) and turns by Im rate · t.

    double cells() const;  ///< Its length in cells; infinite at phase 0.
};

/// Does a rate have an imaginary part that is not rounding?
bool oscillates(Complex rate, double resolution);

/// Waves between two lengths, all of which grow.
struct GrowingBand {
    double least = 0, most = 0;  ///< Their phases. A band may begin at 0 or end at the shortest
                                 ///< wave of the grid.
};

/// What a small change of a flat state does.
enum class Stability : std::uint8_t {
    stable,   ///< It fades, or at least does not grow.
    turing,   ///< Standing waves of some lengths grow; the same in all cells it would not.
    wave,     ///< Travelling or oscillating waves of some lengths grow, in the same way.
    hopf,     ///< An oscillation of all cells together grows.
    both,     ///< The same, and standing waves that grow faster.
    uniform,  ///< It grows even if it is the same in all cells: cells leave the state together.
};

/// A curve of the relation along one direction.
struct Branch {
    std::vector<double> phases;
    std::vector<Complex> largest;  ///< The eigenvalue of largest real part.
    std::vector<Complex> second;   ///< The next one that is not its conjugate; NaN without one.
};

struct Dispersion {
    Stability stability = Stability::stable;
    Complex at_rest;      ///< The largest rate of a change that is the same in all cells, …
    GrowingWave fastest;  ///< … and of all waves other than that.
    std::vector<GrowingBand> bands;  ///< Along its direction, long waves first.
    Branch curve;                    ///< Along its direction.
    bool depends_on_direction = false;
    /// Rates whose magnitude is below this are rounding errors of 0.
    double resolution = 0;

    bool grows_at_rest() const { return at_rest.real() > resolution; }
    bool has_growing_waves() const { return fastest.rate.real() > resolution; }
};

/// The eigenvalues of a wave, by decreasing real part.
std::vector<Complex> eigenvalues(const LinearModel& model, const Matrices& matrices,
                                 const Lattice& lattice, const Phases& phases);

/// The relation of a state with these matrices. Waves shorter than two cells do not exist; on a
/// model, they end at two mean distances of neighbours.
Dispersion dispersion(const LinearModel& model, const Matrices& matrices);

/// What dispersion() says without its curve and bands, in a tenth of the time. Of `fastest` only
/// the wave and its rate are sure.
Dispersion quick_dispersion(const LinearModel& model, const Matrices& matrices);

/// The fastest wave of those that fit the domain, the change that is the same in all cells left
/// out; empty if its size is unknown.
std::optional<GrowingWave> fastest_fitting_wave(const LinearModel& model, const Matrices& matrices);

/// Of the eigenvalues of all waves that fit the cells those that do not grow, for stable steps.
std::vector<Complex> decaying_rates(const LinearModel& model, const Matrices& matrices);

}  // namespace cascade::analysis
