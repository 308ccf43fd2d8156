#include "measure/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace cascade::measure {
namespace {

Samples sampled(const std::function<double(double x, double y)>& f) {
    Samples samples;
    samples.cells = {96, 60, 1};
    samples.spacing.fill(0.5);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 96; ++i) samples.values.push_back(f(i, j));
    }
    return samples;
}

double wave(double x, double length) { return std::cos(2 * std::numbers::pi * x / length); }

TEST(Resolution, ShortWavesAreToldInCells) {
    EXPECT_NEAR(unresolved_wavelength(sampled([](double x, double) { return wave(x, 3); })), 3,
                1e-9);
    EXPECT_NEAR(unresolved_wavelength(sampled([](double, double y) { return 5 + wave(y, 2.5); })),
                2.5, 1e-9);
    // √(1/4.8² + 1/5²) across the diagonal.
    EXPECT_NEAR(unresolved_wavelength(
                    sampled([](double x, double y) { return wave(x, 4.8) * wave(y, 5); })),
                1 / std::hypot(1 / 4.8, 1 / 5.0), 1e-9);
}

TEST(Resolution, WavesOfFourCellsAndMoreAreNot) {
    for (const double length : {4.0, 6.0, 24.0}) {
        EXPECT_TRUE(std::isnan(
            unresolved_wavelength(sampled([&](double x, double) { return wave(x, length); }))));
    }
}

TEST(Resolution, AChequerboardIsNone) {
    EXPECT_TRUE(std::isnan(unresolved_wavelength(
        sampled([](double x, double y) { return std::fmod(x + y, 2) == 0 ? 1.0 : 0.0; }))));
}

TEST(Resolution, NoiseAndEvenFieldsHaveNoWavelength) {
    std::uint32_t state = 1;
    EXPECT_TRUE(std::isnan(unresolved_wavelength(sampled([&](double, double) {
        state = state * 1664525 + 1013904223;
        return static_cast<double>(state >> 8) / (1 << 24);
    }))));
    EXPECT_TRUE(std::isnan(unresolved_wavelength(sampled([](double, double) { return 7.0; }))));
    // A single cell with another value has waves of all lengths.
    EXPECT_TRUE(std::isnan(unresolved_wavelength(
        sampled([](double x, double y) { return x == 40 && y == 30 ? 1.0 : 0.0; }))));
}

TEST(Resolution, ThePartOfShortWavesIsMeasured) {
    std::uint32_t state = 1;
    EXPECT_NEAR(unresolved_part(sampled([&](double, double) {
                    state = state * 1664525 + 1013904223;
                    return static_cast<double>(state >> 8) / (1 << 24);
                })),
                1 - std::numbers::pi / 16, 0.03);
    EXPECT_NEAR(unresolved_part(
                    sampled([](double x, double y) { return wave(x, 3) + wave(y, 20); })),
                0.5, 1e-6);
    EXPECT_EQ(unresolved_part(sampled([](double x, double) { return wave(x, 24); })), 0);
    EXPECT_EQ(unresolved_part(sampled([](double, double) { return 7.0; })), 0);
}

}  // namespace
}  // namespace cascade::measure
