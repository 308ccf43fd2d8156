// The features of a pattern: wavelength (spectrum.h), spots and area (regions.h), direction,
// mean, deviation and range.
#pragma once

#include "measure/samples.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade::measure {

/// Lengths are in the unit of `spacing`. NaN marks features that a field lacks.
struct Features {
    double wavelength = 0;  ///< At the spectrum's peak.
    double spots = 0;       ///< Connected regions above the level halfway from smallest to largest.
    double holes = 0;       ///< Connected regions below that level.
    double area = 0;        ///< Fraction of the cells above that level, 0 … 1.
    double angle = 0;       ///< Direction of the stripes in degrees, [0, 180).
    double anisotropy = 0;  ///< 0 without a preferred direction … 1 for straight stripes.
    double mean = 0;
    double deviation = 0;  ///< Standard deviation over the cells.
    double smallest = 0;
    double largest = 0;
};

inline constexpr std::size_t feature_count = 10;

/// The names of the features, in the order of a table's columns.
const std::array<std::string_view, feature_count>& feature_names();
std::array<double, feature_count> to_array(const Features& features);
Features from_array(const std::array<double, feature_count>& values);

/// A uniform field (core/spread.h) has no wavelength, spots or direction.
Features measure(const Samples& samples);

}  // namespace cascade::measure
