// Sums products of central differences; the eigenvectors of a symmetric 2 × 2 matrix by atan2.
#include "measure/orientation.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace cascade::measure {

namespace {

/// Twice the derivative along an axis, per cell; a neighbour outside counts as the cell itself.
double difference(const Samples& samples, std::size_t cell, std::size_t axis) {
    const double here = samples.values[cell];
    const double ahead = samples.values[samples.neighbour(cell, axis, true)];
    const double behind = samples.values[samples.neighbour(cell, axis, false)];
    return (std::isfinite(ahead) ? ahead : here) - (std::isfinite(behind) ? behind : here);
}

}  // namespace

Orientation orientation_of(const Samples& samples) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (samples.cells[0] == 1 || samples.cells[1] == 1) return {none, none};
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t cell = 0; cell < samples.count(); ++cell) {
        if (!std::isfinite(samples.values[cell])) continue;
        const double dx = difference(samples, cell, 0);
        const double dy = difference(samples, cell, 1);
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
