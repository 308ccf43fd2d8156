// Systems of the library that conserve a quantity, with solvers that also conserve it.
#include "tests/models/dispersion.h"
#include "tests/models/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

/// Symplectic steps conserve an energy whose difference from the true energy is bounded in
/// proportion to the step.
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

/// The sum of the squares of a wave packet is a probability, so it stays 1.
TEST(Waves, SchroedingerKeepsItsParticle) {
    Model model("schroedinger", "grid: 64, 64; boundary: noflux", "momentum: 0.5");
    const double start = model.mean("re^2 + im^2");
    model.step(500);
    EXPECT_NEAR(model.mean("re^2 + im^2") / start, 1, 0.01);
}

/// u = c/2 sech²(√c/2 (x − c t)) keeps its shape and speed c (D. J. Korteweg, G. de Vries 1895).
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

/// After a whole period a wave has its initial form. Its frequency on the grid is ω = 2 sin(k/2).
TEST(Waves, WaveComesBack) {
    const double omega = 2 * std::sin(std::numbers::pi * 4 / 64);
    const double time_step = 2 * std::numbers::pi / omega / 1000;
    Model model("wave", "grid: 64; boundary: periodic",
                "height: cos(8 * pi * x); velocity: 0; speed: " + std::to_string(time_step));
    model.step(1000);
    EXPECT_NEAR(model.at("height", 0), std::cos(8 * std::numbers::pi * 0.5 / 64), 2e-3);
    EXPECT_NEAR(model.largest("abs(velocity)"), 0, 3e-3);
}

/// gain prey − death ln prey + bite predator − birth ln predator is conserved (V. Volterra 1926).
TEST(Waves, LotkaVolterraKeepsVolterrasQuantity) {
    Model model("lotka_volterra", "grid: 2", "solver: rk4; speed: 0.02; prey: 2; predator: 0.7");
    const auto quantity = [&] { return model.mean("prey - log(prey) + predator - log(predator)"); };
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

/// Long waves in a pond have the speed √(gravity · depth). With central differences k becomes sin
/// k.
TEST(Waves, ShallowWaterSwings) {
    const double omega = std::sqrt(2.0) * std::sin(2 * std::numbers::pi * 4 / 64);
    const double time_step = 2 * std::numbers::pi / omega / 1000;
    Model model("shallow_water", "grid: 64; boundary: periodic",
                "viscosity: 0; depth: 2; gravity: 1; height: 1e-4 * cos(8 * pi * x); speed: " +
                    std::to_string(time_step));
    const double before = model.at("height", 0);
    model.step(500);
    EXPECT_NEAR(model.at("height", 0) / before, -1, 5e-3);
    model.step(500);
    EXPECT_NEAR(model.at("height", 0) / before, 1, 5e-3);
    EXPECT_NEAR(model.largest("abs(east)") / before, 0, 0.02);
}

/// The amount of water in the pond is conserved.
TEST(Waves, ShallowWaterStaysInThePond) {
    Model model("shallow_water", "grid: 96, 96; boundary: noflux",
                "east.left: fixed(0); east.right: fixed(0)\n"
                "south.top: fixed(0); south.bottom: fixed(0)");
    const double before = model.mean("height");
    model.step(1500);
    EXPECT_GT(model.deviation("height"), before) << "there are waves";
    EXPECT_NEAR(model.mean("height") / before, 1, 1e-3);
}

/// With p = u' the linear system of a wave of wave number k is u' = p, inertia · p' = (J − k² D) u
/// − p: its eigenvalues give the growth rates of waves in the hyperbolic Brusselator.
TEST(Waves, HyperbolicBrusselatorGrowsAsTheorySays) {
    constexpr int cells = 64, mode = 3;
    const double step = 2 * std::sin(std::numbers::pi * mode / cells);
    std::vector<double> rates;
    for (const double inertia : {0.35, 0.6}) {
        const auto linear = [&](double square) {
            return ReactionDiffusion{
                [=](const State& s) {
                    const double u = (1 - 40 * square) * s[0] + 4 * s[1];
                    const double v = -2 * s[0] - (4 + 0.5 * square) * s[1];
                    return State{s[2], s[3], (u - s[2]) / inertia, (v - s[3]) / inertia};
                },
                {0, 0, 0, 0}};
        };
        const double predicted = growth_rate(linear(step * step), {0, 0, 0, 0}, 0);
        EXPECT_LT(growth_rate(linear(0), {0, 0, 0, 0}, 0), 0) << "without waves it is at rest";
        Model model("hyperbolic_brusselator", "grid: 64",
                    "speed: 0.002; u: 2 + 0.01 * cos(6 * pi * x); v: 1; inertia: " +
                        std::to_string(inertia));
        // The wave oscillates, so its largest amplitude during some periods is measured.
        const auto swing = [&] {
            double most = 0;
            for (int k = 0; k < 100; ++k) {
                model.step(25);
                most = std::max(most, wave_amplitude(model.values("u"), mode));
            }
            return most;
        };
        swing();
        const double early = swing();
        const double late = swing();
        rates.push_back(std::log(late / early) / 5);
        EXPECT_NEAR(rates.back(), predicted, 0.1 * std::abs(predicted) + 0.005) << inertia;
    }
    EXPECT_LT(rates[0], 0);
    EXPECT_GT(rates[1], 0);
}

}  // namespace
}  // namespace cascade::models
