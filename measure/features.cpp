// In a uniform field, only the values are measured. Spots are regions above the mean of the
// smallest and the largest value.
#include "measure/features.h"

#include "core/spread.h"
#include "measure/regions.h"
#include "measure/samples.h"
#include "measure/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace cascade::measure {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The following functions find the direction of stripes from the structure tensor.

/// The direction of a pattern in the plane of x and y.
struct Orientation {
    /// The direction of the stripes in degrees, [0, 180), from the x axis towards the y axis. y
    /// points down in pictures, so 45 is a line from the upper left to the lower right.
    double angle = 0;
    /// 0 without a preferred direction, and 1 for straight parallel stripes.
    double anisotropy = 0;
};

/// The derivative along an axis, per cell. It is of sixth order, so that its error is 1 % for waves
/// of 6 cells. With f(1) − f(−1) alone, the error would be a sixth. Next to the border of the
/// domain, the derivative is of second order, and a neighbour outside counts as having the value of
/// the cell itself.
double derivative(const Samples& samples, std::size_t cell, std::size_t axis) {
    constexpr std::array weights{0.75, -0.15, 1.0 / 60};
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const auto offset = static_cast<std::ptrdiff_t>(k + 1);
        sum += weights[k] * (samples.values[samples.mirrored(cell, axis, offset)] -
                             samples.values[samples.mirrored(cell, axis, -offset)]);
    }
    if (std::isfinite(sum)) return sum;
    const double here = samples.values[cell];
    const double ahead = samples.values[samples.mirrored(cell, axis, 1)];
    const double behind = samples.values[samples.mirrored(cell, axis, -1)];
    return ((std::isfinite(ahead) ? ahead : here) - (std::isfinite(behind) ? behind : here)) / 2;
}

/// Let J = ⟨∇f ∇fᵀ⟩ be the mean over all cells, where ∇f is computed by central differences of
/// sixth order. The main direction of the gradient is then φ = ½ atan2(2 Jxy, Jxx − Jyy),
/// perpendicular to the stripes. The anisotropy is the coherence √((Jxx − Jyy)² + 4 Jxy²) / (Jxx +
/// Jyy). J. Bigün and G. H. Granlund, "Optimal orientation detection of linear symmetry", ICCV
/// 1987. Both results are NaN for uniform fields and one-dimensional grids.
Orientation orientation_of(const Samples& samples) {
    if (samples.cells[0] == 1 || samples.cells[1] == 1) return {none, none};
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t cell = 0; cell < samples.count(); ++cell) {
        if (!std::isfinite(samples.values[cell])) continue;
        const double dx = derivative(samples, cell, 0);
        const double dy = derivative(samples, cell, 1);
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    if (!(xx + yy > 0)) return {none, none};
    const double across = 0.5 * std::atan2(2 * xy, xx - yy);
    double angle = across * 180 / std::numbers::pi + 90;
    if (angle >= 180) angle -= 180;
    return {angle, std::hypot(xx - yy, 2 * xy) / (xx + yy)};
}

/// Sets the mean, deviation, smallest and largest value. They are NaN if there are no cells.
Spread measure_values(const Samples& samples, Features& features) {
    const Spread spread = spread_of([&](const auto& take) {
        for (const double value : samples.values) take(value);
    });
    const bool is_empty = spread.count == 0;
    features.mean = is_empty ? none : spread.mean;
    features.deviation = is_empty ? none : spread.deviation();
    features.smallest = is_empty ? none : spread.smallest;
    features.largest = is_empty ? none : spread.largest;
    return spread;
}

}  // namespace

const std::array<std::string_view, feature_count>& feature_names() {
    static constexpr std::array<std::string_view, feature_count> names = {
        "wavelength", "spots", "holes",     "area",     "angle",
        "anisotropy", "mean",  "deviation", "smallest", "largest"};
    return names;
}

std::array<double, feature_count> to_array(const Features& f) {
    return {f.wavelength, f.spots, f.holes,     f.area,     f.angle,
            f.anisotropy, f.mean,  f.deviation, f.smallest, f.largest};
}

Features from_array(const std::array<double, feature_count>& v) {
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9]};
}

Features measure(const Samples& samples) {
    Features features;
    if (measure_values(samples, features).is_uniform()) {
        features.wavelength = features.spots = features.holes = features.area = none;
        features.angle = features.anisotropy = none;
        return features;
    }
    features.wavelength = peak_wavelength(radial_spectrum(samples));
    const Regions regions = find_regions(samples, (features.smallest + features.largest) / 2);
    features.spots = static_cast<double>(regions.above);
    features.holes = static_cast<double>(regions.below);
    features.area = regions.area;
    const Orientation orientation = orientation_of(samples);
    features.angle = orientation.angle;
    features.anisotropy = orientation.anisotropy;
    return features;
}

}  // namespace cascade::measure
