// Systems of the library that keep something for ever, with solvers that keep it.
#include "tests/models/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

/// Symplectic steps keep an energy that differs from the true one by a bounded part of the step.
TEST(Waves, WaveKeepsItsEnergy) {
    Model model("wave", "grid: 64; boundary: periodic",
                "speed: 0.2; height: cos(8 * pi * x) + 0.3 * cos(20 * pi * x); velocity: 0");
    const auto energy = [&] {
        const std::vector<double> height = model.values("height");
        const std::vector<double> velocity = model.values("velocity");
        double sum = 0;
        for (std::size_t i = 0; i < height.size(); ++i) {
            const double slope = height[(i + 1) % height.size()] - height[i];
            sum += velocity[i] * velocity[i] / 2 + slope * slope / 2;
        }
        return sum;
    };
    const double start = energy();
    for (int k = 0; k < 50; ++k) {
        model.step(400);
        EXPECT_NEAR(energy() / start, 1, 0.12) << k;
    }
}

/// The square of a wave packet is a probability: it stays 1.
TEST(Waves, SchroedingerKeepsItsParticle) {
    Model model("schroedinger", "grid: 64, 64; boundary: noflux", "momentum: 0.5");
    const double start = model.mean("re^2 + im^2");
    model.step(500);
    EXPECT_NEAR(model.mean("re^2 + im^2") / start, 1, 0.01);
}

/// D. J. Korteweg, G. de Vries 1895: u = c/2 sech²(√c/2 (x − c t)) keeps its shape and speed c.
TEST(Waves, KdvSoliton) {
    Model model("kdv", "grid: 256; spacing: 0.25",
                "speed: 0.008; length: 64; c2: 0.0001; c1: 0.6; u: [c1] / 2 / "
                "cosh(sqrt([c1]) / 2 * [length] * (x - 0.3))^2 + 0 * [c2]");
    const auto peak = [&] {
        const std::vector<double> row = model.values("u");
        std::size_t top = 0;
        for (std::size_t i = 1; i < row.size(); ++i) {
            if (row[i] > row[top]) top = i;
        }
        const double left = row[top - 1], here = row[top], right = row[top + 1];
        return 0.25 * (static_cast<double>(top) + (left - right) / (2 * (left - 2 * here + right)));
    };
    const double first = peak();
    model.step(4000);
    EXPECT_NEAR((peak() - first) / 32, 0.6, 0.02);
    EXPECT_NEAR(model.largest("u"), 0.3, 0.006);
}

/// The frequency of a wave on the grid, ω = 2 sin(k/2): after a whole period it is back.
TEST(Waves, WaveComesBack) {
    const double omega = 2 * std::sin(std::numbers::pi * 4 / 64);
    const double time_step = 2 * std::numbers::pi / omega / 1000;
    Model model("wave", "grid: 64; boundary: periodic",
                "height: cos(8 * pi * x); velocity: 0; speed: " + std::to_string(time_step));
    model.step(1000);
    EXPECT_NEAR(model.at("height", 0), std::cos(8 * std::numbers::pi * 0.5 / 64), 2e-3);
    EXPECT_NEAR(model.largest("abs(velocity)"), 0, 3e-3);
}

/// V. Volterra 1926: gain prey − death ln prey + bite predator − birth ln predator.
TEST(Waves, LotkaVolterraKeepsVolterrasQuantity) {
    Model model("lotka_volterra", "grid: 2", "solver: rk4; speed: 0.02; prey: 2; predator: 0.7");
    const auto quantity = [&] {
        return model.mean("prey - log(prey) + predator - log(predator)");
    };
    const double start = quantity();
    double least = 10, most = 0;
    for (int k = 0; k < 20; ++k) {
        model.step(50);
        EXPECT_NEAR(quantity(), start, 1e-4) << k;
        least = std::min(least, model.at("prey", 0));
        most = std::max(most, model.at("prey", 0));
    }
    EXPECT_GT(most - least, 1) << "it goes round";
}

}  // namespace
}  // namespace cascade::models
