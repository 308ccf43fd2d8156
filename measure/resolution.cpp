// First computes the correlation of neighbours, which takes little time. Computes a spectrum only
// if that correlation is low.
#include "measure/resolution.h"

#include "core/spread.h"
#include "measure/spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade::measure {

namespace {

/// A field counts as having a single wavelength if the peak of its spectrum contains at least this
/// fraction of the variance.
constexpr double regular_share = 0.75;

/// If waves are at most four cells long, the correlation of neighbours along at least one axis is
/// below this. In the worst case, a diagonal wave in a volume, the correlation is cos(2π / (4 √3))
/// = 0.62.
constexpr double close_correlation = 0.65;

double correlation_along(const Samples& samples, const Spread& spread, std::size_t axis) {
    double products = 0, pairs = 0;
    for (std::size_t cell = 0; cell < samples.count(); ++cell) {
        const std::size_t next = samples.neighbour(cell, axis, true);
        const double a = samples.values[cell], b = samples.values[next];
        if (next == cell || !std::isfinite(a) || !std::isfinite(b)) continue;
        products += (a - spread.mean) * (b - spread.mean);
        pairs += 1;
    }
    return pairs > 0 ? products / pairs / (spread.squares / spread.count) : 1;
}

/// Whether neighbours are so weakly correlated that waves may be shorter than `fewest_cells_a_wave`
/// cells.
bool may_be_unresolved(const Samples& samples) {
    const Spread spread = spread_of([&](const auto& take) {
        for (const double value : samples.values) take(value);
    });
    if (spread.is_uniform()) return false;
    double least = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (samples.cells[axis] > 1) {
            least = std::min(least, correlation_along(samples, spread, axis));
        }
    }
    return least <= close_correlation;
}

}  // namespace

double unresolved_wavelength(const Samples& samples) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!may_be_unresolved(samples)) return none;
    const Spectrum spectrum = radial_spectrum(samples);
    const double cells = peak_wavelength(spectrum) / samples.spacing[0];
    // A wave of two cells is a chequerboard, which other code reports.
    const bool is_short =
        cells > 2 && cells < fewest_cells_a_wave && peak_share(spectrum) >= regular_share;
    return is_short ? cells : none;
}

double unresolved_part(const Samples& samples) {
    if (!may_be_unresolved(samples)) return 0;
    const Spectrum spectrum = radial_spectrum(samples);
    // The wave number of the longest unresolved wave.
    const double longest = 1 / (fewest_cells_a_wave * samples.spacing[0]);
    double whole = 0, part = 0;
    for (std::size_t ring = 0; ring < spectrum.power.size(); ++ring) {
        whole += spectrum.power[ring];
        if (static_cast<double>(ring) * spectrum.ring_width > longest) part += spectrum.power[ring];
    }
    return whole > 0 ? part / whole : 0;
}

}  // namespace cascade::measure
