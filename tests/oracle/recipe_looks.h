// Numbers that the patterns of the recipes in Turk's thesis must have.
//
// They were found for every printed recipe with an independent program (double precision, other
// random numbers, 64 × 64 and 128 × 128, several seeds). If only a description is known, the range
// is wide. Areas, wavelengths and deviations are the same on both grids, but counts are not.
#pragma once

#include <span>
#include <string_view>

namespace cascade {

enum class Measure {
    regions_below,  ///< Connected regions with values below `level`.
    regions_above,  ///< Connected regions with values above `level`.
    bumps,          ///< Connected regions above the middle of the smallest and largest value.
    area_below,     ///< Fraction of the cells with values below `level`.
    area_above,
    peak_wavelength,  ///< In cells. Like all properties below, it ignores `level`.
    mean_wavelength,
    anisotropy,
    deviation,
};

struct Range {
    double low = 0, high = 0;
};

/// One expectation about a species at the end of a stage.
struct Look {
    std::string_view script;
    int stage = 1;
    const char* species = "b";
    Measure measure = Measure::regions_below;
    double level = 0;
    Range at_64, at_128;
};

std::span<const Look> recipe_looks();

}  // namespace cascade
