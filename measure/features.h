// What a pattern looks like, in numbers.
//
//     Samples → wavelength (spectrum.h), spots and area (regions.h), direction (orientation.h),
//     mean, deviation, ends: one record, one row of a table.
#pragma once

#include "measure/samples.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cascade::measure {

/// Lengths are in the unit of `spacing`. NaN stands for what a field does not have: a field that is
/// even has no wavelength.
struct Features {
    double wavelength = 0;  ///< At the spectrum's peak.
    double spots = 0;       ///< Connected parts above the level half way from smallest to largest.
    double holes = 0;       ///< Connected parts below that level.
    double area = 0;        ///< Part of the cells above that level, 0 … 1.
    double angle = 0;       ///< Direction of the stripes in degrees, [0, 180); see orientation.h.
    double anisotropy = 0;  ///< 0 without a preferred direction … 1 for straight stripes.
    double mean = 0;
    double deviation = 0;  ///< Standard deviation over the cells.
    double smallest = 0;
    double largest = 0;
};

inline constexpr std::size_t feature_count = 10;

/// Their names, in order of the table's columns.
const std::array<std::string_view, feature_count>& feature_names();
std::array<double, feature_count> to_array(const Features& features);
Features from_array(const std::array<double, feature_count>& values);

/// A field that is even (core/spread.h) has neither wavelength nor spots nor direction.
Features measure(const Samples& samples);

}  // namespace cascade::measure
