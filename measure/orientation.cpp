// Sums products of differences; the eigenvectors of a symmetric 2 × 2 matrix by atan2.
#include "measure/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace cascade::measure {

namespace {

/// The derivative along an axis, per cell, of sixth order: exact to 1 % for waves of 6 cells, of
/// which f(1) − f(−1) alone would lose a sixth. Where it would read a cell outside of the domain,
/// of second order, and a neighbour outside counts as the cell itself.
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

}  // namespace

Orientation orientation_of(const Samples& samples) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
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

}  // namespace cascade::measure
