// Even fields only have a mean; spots are counted at the level halfway from smallest to largest.
#include "measure/features.h"

#include "core/spread.h"
#include "measure/orientation.h"
#include "measure/regions.h"
#include "measure/spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade::measure {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Sets mean, deviation, smallest and largest; NaN if there are no cells.
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
    if (measure_values(samples, features).is_even()) {
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
