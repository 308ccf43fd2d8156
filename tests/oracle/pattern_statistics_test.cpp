// Statistics of patterns for which they can be computed by hand.
#include "tests/oracle/pattern_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace cascade {
namespace {

bool is_set(double value) { return value > 0.5; }

/// 'o' is 1, everything else 0.
Pattern2d drawing(std::size_t width, std::string_view cells) {
    Pattern2d pattern{width, cells.size() / width, {}};
    for (const char cell : cells) pattern.values.push_back(cell == 'o' ? 1 : 0);
    return pattern;
}

/// A plane wave of kx and ky waves across the picture.
Pattern2d wave(std::size_t size, double kx, double ky) {
    Pattern2d pattern{size, size, {}};
    for (std::size_t cell = 0; cell < size * size; ++cell) {
        const double phase =
            (kx * static_cast<double>(cell % size) + ky * static_cast<double>(cell / size)) /
            static_cast<double>(size);
        pattern.values.push_back(3 + 2 * std::sin(2 * std::numbers::pi * phase));
    }
    return pattern;
}

TEST(PatternStatistics, RegionsGoAcrossTheBordersAndNotAcrossCorners) {
    const Pattern2d pattern = drawing(6,
                                      "o....o"
                                      "..o..."
                                      "...o.."
                                      "......"
                                      "oo..oo");
    EXPECT_EQ(count_regions(pattern, is_set), 3u);
    EXPECT_EQ(count_regions(pattern, is_set, 2), 1u);
    EXPECT_EQ(count_regions(pattern, is_set, 7), 0u);
    EXPECT_EQ(count_regions(pattern, [](double value) { return !is_set(value); }), 1u);
    EXPECT_DOUBLE_EQ(area_fraction(pattern, is_set), 8.0 / 30);
}

TEST(PatternStatistics, MomentsOfAWave) {
    const Moments result = moments(wave(32, 3, 0));
    EXPECT_NEAR(result.mean, 3, 1e-12);
    EXPECT_NEAR(result.deviation, std::numbers::sqrt2, 1e-12);
}

TEST(PatternStatistics, APlaneWaveHasItsWavelengthAndOneDirection) {
    const SpectrumSummary summary = summarise_spectrum(wave(60, 3, 4));
    EXPECT_NEAR(summary.peak_wavelength, 12, 1e-9);
    EXPECT_NEAR(summary.mean_wavelength, 12, 1e-9);
    EXPECT_NEAR(summary.anisotropy, 1, 1e-9);
}

TEST(PatternStatistics, CrossedWavesHaveNoDirection) {
    Pattern2d crossed = wave(48, 6, 0);
    const Pattern2d other = wave(48, 0, 6);
    for (std::size_t cell = 0; cell < crossed.values.size(); ++cell) {
        crossed.values[cell] += other.values[cell];
    }
    const SpectrumSummary summary = summarise_spectrum(crossed);
    EXPECT_NEAR(summary.peak_wavelength, 8, 1e-9);
    EXPECT_NEAR(summary.anisotropy, 0, 1e-9);
    EXPECT_NEAR(correlation(crossed, other), std::numbers::sqrt2 / 2, 1e-9);
}

TEST(PatternStatistics, ThePeakIgnoresHarmonics) {
    Pattern2d pattern = wave(60, 4, 0);
    const Pattern2d harmonic = wave(60, 12, 0);
    for (std::size_t cell = 0; cell < pattern.values.size(); ++cell) {
        pattern.values[cell] += 0.5 * harmonic.values[cell];
    }
    const SpectrumSummary summary = summarise_spectrum(pattern);
    EXPECT_NEAR(summary.peak_wavelength, 15, 1e-9);
    EXPECT_NEAR(summary.mean_wavelength, 60 / ((4 + 0.25 * 12) / 1.25), 1e-9);
}

TEST(PatternStatistics, ALineIsARow) {
    Pattern2d line{60, 1, {}};
    for (int i = 0; i < 60; ++i) line.values.push_back(std::cos(2 * std::numbers::pi * i / 7.5));
    EXPECT_NEAR(summarise_spectrum(line).peak_wavelength, 7.5, 1e-9);
    EXPECT_EQ(count_regions(line, is_set), 8u);
}

}  // namespace
}  // namespace cascade
