// Measures the features of a pattern: wavelength (spectrum.h), spots and area (regions.h),
// direction, mean, deviation and range.
#pragma once

#include "measure/samples.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade::measure {

/// Lengths are in the unit of `spacing`. NaN means that the field does not have the feature.
struct Features {
    double wavelength = 0;  ///< The wavelength at the peak of the spectrum.
    /// The number of connected regions with values above the mean of the smallest and the largest
    /// value.
    double spots = 0;
    /// The number of connected regions with values below the mean of the smallest and the largest
    /// value.
    double holes = 0;
    /// The fraction of the cells with values above the mean of the smallest and the largest value,
    /// 0 … 1.
    double area = 0;
    double angle = 0;       ///< The direction of the stripes in degrees, [0, 180).
    double anisotropy = 0;  ///< 0 without a preferred direction, and 1 for straight stripes.
    double mean = 0;
    double deviation = 0;  ///< The standard deviation over the cells.
    double smallest = 0;
    double largest = 0;
};

inline constexpr std::size_t feature_count = 10;

/// The names of the features, in the order of the members.
const std::array<std::string_view, feature_count>& feature_names();
std::array<double, feature_count> to_array(const Features& features);
Features from_array(const std::array<double, feature_count>& values);

/// Measures all features. A uniform field (core/spread.h) has no wavelength, spots or direction.
Features measure(const Samples& samples);

}  // namespace cascade::measure
