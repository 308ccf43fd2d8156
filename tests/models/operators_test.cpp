// Systems of the library with operators of their own: fourth order, fluxes, waves.
#include "tests/models/model.h"

#include "measure/features.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Operators, HeatFades) {
    Model model("heat", "grid: 64", "speed: 0.2; diffusion: 1; u: 1 + 0.5 * cos(8 * pi * x)");
    model.step(200);
    const double step = 2 * std::sin(pi * 4 / 64);
    const double expected = 0.5 * std::pow(1 - 0.2 * step * step, 200);
    EXPECT_NEAR(wave_amplitude(model.values("u"), 4) / expected, 1, 1e-4);
    EXPECT_NEAR(model.mean("u"), 1, 1e-5);
}

/// J. Swift, P. C. Hohenberg 1977: rolls of wavelength 2 π / kc grow at r.
TEST(Operators, SwiftHohenberg) {
    Model model("swift_hohenberg", "grid: 128, 128", "kc: 0.6; r: 0.2; speed: 0.015");
    model.step(6000);
    measure::Samples samples;
    samples.cells = {128, 128, 1};
    samples.values = model.values("u");
    const double predicted = pi / std::asin(0.6 / 2);  // 2 π / kc, seen through the grid.
    EXPECT_NEAR(measure::measure(samples).wavelength / predicted, 1, 0.03);
    EXPECT_NEAR(predicted / (2 * pi / 0.6), 1, 0.02);
    // The amplitude of a roll, √(4 r / 3).
    EXPECT_NEAR(model.largest("u"), std::sqrt(4 * 0.2 / 3), 0.15);
}

TEST(Operators, SwiftHohenbergThreshold) {
    for (const double r : {-0.05, 0.05}) {
        constexpr int cells = 60, mode = 6;
        const double kc = 2 * std::sin(pi * mode / cells);
        Model model("swift_hohenberg", "grid: 60",
                    fmt::format("speed: 0.02; kc: {}; r: {}; u: 0.01 * cos(12 * pi * x)", kc, r));
        const double before = wave_amplitude(model.values("u"), mode);
        model.step(1000);
        const double rate = std::log(wave_amplitude(model.values("u"), mode) / before) / 20;
        EXPECT_NEAR(rate, r, 0.002);
    }
}

TEST(Operators, CahnHilliardKeepsItsMass) {
    Model model("cahn_hilliard", "grid: 64, 64", "balance: 0.2");
    const double before = model.mean("c");
    model.step(4000);
    EXPECT_NEAR(model.mean("c"), before, 1e-5);
    EXPECT_GT(model.deviation("c"), 0.7) << "it has come apart";
    // Walls of finite curvature shift the two phases a little beyond ±1.
    EXPECT_NEAR(model.largest("c"), 1, 0.1);
    EXPECT_NEAR(model.smallest("c"), -1, 0.1);
}

TEST(Operators, PhaseFieldCrystalKeepsItsMass) {
    Model model("phase_field_crystal", "grid: 48, 48; spacing: 1.1", "");
    const double before = model.mean("density");
    model.step(4000);
    EXPECT_NEAR(model.mean("density"), before, 1e-5);
}

/// The flat state gives way at pull / 2 = (√(D1 a) + √(D2 g))², with decay a and growth g.
TEST(Operators, KellerSegelThreshold) {
    const double decay = 0.1, growth = 1;
    const double root = std::sqrt(decay) + std::sqrt(growth);
    for (const double part : {0.9, 1.15}) {
        Model model("keller_segel", "grid: 64, 64",
                    fmt::format("speed: 0.02; growth: 1; decay: 0.1; diff_cells: 1; diff_bait: 1\n"
                                "pull: {}; cells: random(1, 0.01); bait: 10",
                                2 * part * root * root));
        model.step(500);
        const double before = model.deviation("cells");
        model.step(3000);
        EXPECT_EQ(model.deviation("cells") > before, part > 1) << part;
    }
}

TEST(Operators, KellerSegelKeepsItsCells) {
    Model model("keller_segel", "grid: 64, 64", "growth: 0; pull: 8");
    const double before = model.mean("cells");
    model.step(5000);
    EXPECT_NEAR(model.mean("cells") / before, 1, 1e-5);
    EXPECT_GT(model.deviation("cells"), 0.2) << "they have gathered";
}

/// G. I. Barenblatt 1952, u_t = Δ(u²) on a plane: u = t^(-1/2) max(0, c − r² t^(-1/2) / 16).
TEST(Operators, PorousMediumSpreadsAsBarenblatt) {
    Model model("porous_medium", "grid: 128, 128",
                "speed: 0.02; permeability: 1\n"
                "gas: max(0, 4 - (128^2 * ((x - 0.5)^2 + (y - 0.5)^2)) / 160) / 10");
    // At t0 = 100: t^(-1/2) = 1/10, c = 4, and at 4 t0 half as high and √2 as wide.
    const double before = model.mean("gas");
    EXPECT_NEAR(model.largest("gas"), 0.4, 0.002);
    model.step(15000);
    EXPECT_NEAR(model.mean("gas") / before, 1, 1e-4);
    EXPECT_NEAR(model.largest("gas"), 0.2, 0.003);
    const double covered = model.mean("gas > 0.002") * 128 * 128;
    EXPECT_NEAR(covered / (pi * 16 * 20 * (4 - 0.002 * 20)), 1, 0.04);
}

/// A step from 1 to 0 runs at the mean of both; its slope is (Δu)² / (8 ν) in the middle.
TEST(Operators, BurgersShock) {
    Model model("burgers", "grid: 300; boundary: noflux",
                "speed: 0.05; viscosity: 2; u: (1 - tanh((300 * x - 60) / 8)) / 2");
    model.step(1000);
    const double first = front_position(model.values("u"), 0.5);
    model.step(4000);
    const std::vector<double> row = model.values("u");
    const double second = front_position(row, 0.5);
    EXPECT_NEAR((second - first) / 200, 0.5, 0.005);
    const auto middle = static_cast<std::size_t>(second);
    const double slope = (row[middle - 1] - row[middle + 1]) / 2;
    EXPECT_NEAR(slope / (1.0 / (8 * 2)), 1, 0.05);
}

/// It neither dies nor grows without bound.
TEST(Operators, KuramotoSivashinskyStaysBounded) {
    Model model("kuramoto_sivashinsky", "grid: 64, 64", "");
    model.step(5000);
    for (int k = 0; k < 5; ++k) {
        model.step(2000);
        const double range = model.largest("height") - model.smallest("height");
        EXPECT_GT(range, 2);
        EXPECT_LT(range, 40);
    }
}

/// Edges stay, the mean stays, nothing goes beyond what there was.
TEST(Operators, PeronaMalikKeepsEdges) {
    Model model("perona_malik", "grid: 64, 64; boundary: noflux",
                "brightness: (x > 0.5) + random(0, 0.05)");
    const double before = model.mean("brightness"),
                 noise = model.deviation("brightness - (x > 0.5)");
    model.step(400);
    EXPECT_NEAR(model.mean("brightness"), before, 1e-5);
    EXPECT_LT(model.deviation("brightness - (x > 0.5)"), 0.5 * noise);
    EXPECT_LE(model.largest("brightness"), 1.06);
}

/// Bands of bush climb: against the water, which runs towards x = 0.
TEST(Operators, KlausmeierBandsClimb) {
    Model model("klausmeier", "grid: 128; spacing: 1", "");
    model.step(20000);
    const std::vector<double> before = model.values("plants");
    model.step(400);
    const std::vector<double> after = model.values("plants");
    const auto overlap = [&](int shift) {
        double sum = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            sum += before[i] * after[(i + 128 + static_cast<std::size_t>(shift + 128)) % 128];
        }
        return sum;
    };
    EXPECT_GT(model.deviation("plants"), 0.1);
    double ahead = 0, behind = 0;
    for (int shift = 1; shift <= 2; ++shift) {
        ahead += overlap(shift);
        behind += overlap(-shift);
    }
    EXPECT_GT(ahead, behind);
}

/// A. Witkin, M. Kass 1991, their zebra: Euler's limit is 2 / (4 (a11 + a22) + b) = 0.0769.
TEST(Operators, ZebraHasItsLimitOfTheTimeStep) {
    const std::string zebra =
        "domain {{ grid: 64, 64 }}\n"
        "system zebra: witkin_kass {{ i: 1..1; theta[i]: pi/3; e: 2; rho: 0 }}\n"
        "stage coat: zebra {{ iterations: 1000; speed: {} }}\n";
    Model below(fmt::format(fmt::runtime(zebra), 0.0765));
    below.finish();
    EXPECT_LT(below.largest("minus[1]"), 10);
    Pattern above(fmt::format(fmt::runtime(zebra), 0.078), [] {
        PatternOptions options;
        options.native_code = CASCADE_HAS_JIT != 0;
        return options;
    }());
    ASSERT_TRUE(above.ok()) << above.messages();
    above.step(1000);
    double largest = 0;
    for (const float value : above.values("minus[1]")) largest = std::max<double>(largest, value);
    EXPECT_TRUE(!above.error().empty() || largest > 1e6) << largest;
}

}  // namespace
}  // namespace cascade::models
