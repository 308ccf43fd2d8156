// Features of patterns whose features are known.
#include "measure/features.h"
#include "measure/regions.h"
#include "measure/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

namespace cascade::measure {
namespace {

using std::numbers::pi;

/// The values of f at the centres of cells. The unit of its coordinates is a cell.
Samples sampled(std::size_t width, std::size_t height, std::size_t depth,
                const std::function<double(double x, double y, double z)>& f) {
    Samples samples;
    samples.cells = {width, height, depth};
    for (std::size_t k = 0; k < depth; ++k) {
        for (std::size_t j = 0; j < height; ++j) {
            for (std::size_t i = 0; i < width; ++i) {
                samples.values.push_back(f(static_cast<double>(i) + 0.5,
                                           static_cast<double>(j) + 0.5,
                                           static_cast<double>(k) + 0.5));
            }
        }
    }
    return samples;
}

/// A plane wave with `a` periods across and `b` periods down.
Samples stripes(std::size_t width, std::size_t height, double a, double b) {
    return sampled(width, height, 1, [=](double x, double y, double) {
        return 3 +
               std::cos(2 * pi *
                        (a * x / static_cast<double>(width) + b * y / static_cast<double>(height)));
    });
}

TEST(Features, DoNotDependOnTheUnitOfValues) {
    const Samples samples = stripes(96, 64, 12, 0);
    const Features usual = measure(samples);
    for (const double unit : {1e-12, 1e-18, 1e12}) {
        Samples scaled = samples;
        for (double& value : scaled.values) value *= unit;
        const Features found = measure(scaled);
        EXPECT_NEAR(found.wavelength, usual.wavelength, 1e-9) << unit;
        EXPECT_EQ(found.spots, usual.spots) << unit;
        EXPECT_NEAR(found.deviation, usual.deviation * unit, 1e-9 * unit) << unit;
    }
}

TEST(Features, StripesAcross) {
    const Features found = measure(stripes(96, 64, 12, 0));
    EXPECT_NEAR(found.wavelength, 8, 1e-9);
    EXPECT_EQ(found.spots, 12);
    EXPECT_EQ(found.holes, 12);
    EXPECT_NEAR(found.area, 0.5, 1e-12);
    EXPECT_NEAR(found.angle, 90, 1e-9);
    EXPECT_NEAR(found.anisotropy, 1, 1e-12);
    EXPECT_NEAR(found.mean, 3, 1e-12);
    EXPECT_NEAR(found.deviation, std::sqrt(0.5), 1e-12);
}

TEST(Features, ObliqueStripesOfEveryDirection) {
    // Wave vector (a, b) on a square: |k| = √(a² + b²), stripes at right angles to it.
    for (const auto& [a, b] : {std::pair{6, 6}, {6, -6}, {8, 3}, {0, 7}, {-2, 9}, {5, 12}}) {
        const Features found = measure(stripes(128, 128, a, b));
        EXPECT_NEAR(found.wavelength, 128 / std::hypot(a, b), 1e-9) << a << ' ' << b;
        const double angle = std::fmod(std::atan2(b, a) * 180 / pi + 270, 180);
        EXPECT_NEAR(found.angle, angle, 0.01) << a << ' ' << b;
        EXPECT_GT(found.anisotropy, 0.999999);
    }
}

TEST(Features, ObliqueWavesBetweenMirrors) {
    // Products of waves have the sides as axes. The axis with more waves counts.
    Samples samples = sampled(64, 64, 1, [](double x, double y, double) {
        return std::cos(pi * 16 * x / 64) + 0.5 * std::cos(pi * 24 * y / 64);
    });
    samples.periodic = {false, false, false};
    // ⟨f_x²⟩ : ⟨f_y²⟩ is (1 · 16)² : (½ · 24)² = 16² : 12².
    EXPECT_NEAR(measure(samples).anisotropy, (256.0 - 144) / (256 + 144), 0.02);
    EXPECT_NEAR(measure(samples).angle, 90, 1e-6);
}

TEST(Features, LengthsAreInTheUnitOfTheSpacing) {
    Samples samples = stripes(96, 64, 12, 0);
    samples.spacing.fill(0.25);
    EXPECT_NEAR(measure(samples).wavelength, 2, 1e-9);
}

TEST(Features, WavesBetweenMirrors) {
    // cos(π n x / W) is a wave of a domain with no flux, also for odd n.
    for (const double n : {3.0, 10.0, 21.0}) {
        Samples samples = sampled(128, 32, 1, [&](double x, double, double) {
            return std::cos(pi * n * x / 128);
        });
        samples.periodic = {false, false, false};
        EXPECT_NEAR(measure(samples).wavelength, 2 * 128 / n, 1e-9);
        samples.periodic = {false, true, true};
        EXPECT_NEAR(measure(samples).wavelength, 2 * 128 / n, 1e-9);
    }
}

TEST(Features, LinesAndBoxes) {
    const Samples line = stripes(120, 1, 10, 0);
    const Features of_line = measure(line);
    EXPECT_NEAR(of_line.wavelength, 12, 1e-9);
    EXPECT_EQ(of_line.spots, 10);
    EXPECT_TRUE(std::isnan(of_line.angle));
    const Samples box =
        sampled(16, 12, 24, [](double, double, double z) { return std::sin(2 * pi * z / 6); });
    EXPECT_NEAR(measure(box).wavelength, 6, 1e-9);
    EXPECT_EQ(measure(box).spots, 4);
}

/// Bumps on a lattice of n × n.
Samples bumps(std::size_t side, double n) {
    return sampled(side, side, 1, [=](double x, double y, double) {
        const double step = 2 * pi * n / static_cast<double>(side);
        return std::exp(2 * (std::cos(step * x) + std::cos(step * y)));
    });
}

TEST(Features, SpotsAreCountedAcrossPeriodicBorders) {
    // The bumps' centres are at the corners: a border cuts them.
    Samples samples = bumps(100, 5);
    Features found = measure(samples);
    EXPECT_EQ(found.spots, 25);
    EXPECT_EQ(found.holes, 1);
    EXPECT_NEAR(found.wavelength, 20, 0.5);
    EXPECT_LT(found.anisotropy, 1e-9);
    // Without periodic sides, there are 4 × 4 whole bumps, 4 · 4 halves and the 4 corners.
    samples.periodic = {false, false, false};
    EXPECT_EQ(measure(samples).spots, 36);
    for (double& value : samples.values) value = -value;
    EXPECT_EQ(measure(samples).spots, 1);
    EXPECT_EQ(measure(samples).holes, 36);
}

TEST(Features, AreaOfADisc) {
    const Samples disc = sampled(200, 200, 1, [](double x, double y, double) {
        return std::hypot(x - 100, y - 100) < 60 ? 1.0 : 0.0;
    });
    const Features found = measure(disc);
    EXPECT_NEAR(found.area, pi * 3600 / 40000, 1e-3);
    EXPECT_EQ(found.spots, 1);
}

TEST(Features, AnEvenFieldHasNoPattern) {
    const Features found = measure(sampled(32, 32, 1, [](double x, double, double) {
        return 7 + 1e-6 * x;  // Rounding.
    }));
    for (const double absent :
         {found.wavelength, found.spots, found.holes, found.area, found.angle, found.anisotropy}) {
        EXPECT_TRUE(std::isnan(absent));
    }
    EXPECT_NEAR(found.mean, 7 + 16e-6, 1e-9);
    EXPECT_NEAR(found.deviation, 9.2e-6, 1e-7);
}

TEST(Features, CellsOutsideCountForNothing) {
    Samples samples = stripes(96, 64, 12, 0);
    for (std::size_t cell = 96 * 32; cell < samples.count(); ++cell) {
        samples.values[cell] = std::numeric_limits<double>::quiet_NaN();
    }
    samples.periodic = {true, false, true};
    const Features found = measure(samples);
    EXPECT_NEAR(found.wavelength, 8, 0.1);
    EXPECT_EQ(found.spots, 12);
    EXPECT_NEAR(found.area, 0.5, 1e-12);
    EXPECT_NEAR(found.mean, 3, 1e-12);
    EXPECT_NEAR(found.anisotropy, 1, 1e-12);
    for (double& value : samples.values) value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(measure(samples).mean));
}

TEST(Features, TheSpectrumHoldsTheWholeVariance) {
    // Parseval's theorem, for every combination of sides, and for even and odd numbers of cells.
    for (const bool across : {true, false}) {
        for (const bool down : {true, false}) {
            for (const std::size_t height : {18U, 25U}) {
                std::uint32_t word = 1;
                Samples samples = sampled(31, height, 3, [&](double, double, double) {
                    word = word * 1664525u + 1013904223u;
                    return static_cast<double>(word) / 4294967296.0;
                });
                samples.periodic = {across, down, across != down};
                const Spectrum spectrum = radial_spectrum(samples);
                const double deviation = measure(samples).deviation;
                EXPECT_NEAR(std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0),
                            deviation * deviation, 1e-12);
            }
        }
    }
}

TEST(Features, NamesAndNumbersAreInOneOrder) {
    const Features features{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    const auto values = to_array(features);
    for (std::size_t k = 0; k < feature_count; ++k) {
        EXPECT_EQ(values[k], static_cast<double>(k + 1));
    }
    EXPECT_EQ(to_array(from_array(values)), values);
    EXPECT_EQ(feature_names()[0], "wavelength");
    EXPECT_EQ(feature_names()[9], "largest");
    EXPECT_EQ(feature_names()[6], "mean");
}

TEST(Features, ALongSpotOverflowsNothing) {
    // One region of a million cells, for which recursion would overflow the stack.
    const Samples one = sampled(1000, 1000, 1, [](double, double y, double) { return y; });
    EXPECT_EQ(find_regions(one, -1).above, 1);
    EXPECT_EQ(find_regions(one, -1).below, 0);
}

}  // namespace
}  // namespace cascade::measure
