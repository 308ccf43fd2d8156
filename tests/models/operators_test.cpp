// Systems of the library with special operators: a wavelength, a front, moving bands, a limit of
// the step. tests/scripts/library tests what they conserve and how they grow.
#include "tests/models/model.h"

#include "measure/features.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

using std::numbers::pi;

/// Rolls of the wavelength 2 π / kc grow at the rate r (J. Swift, P. C. Hohenberg 1977).
TEST(Operators, SwiftHohenberg) {
    Model model("swift_hohenberg", "grid: 128, 128", "kc: 0.6; r: 0.2; speed: 0.015");
    model.step(6000);
    measure::Samples samples;
    samples.cells = {128, 128, 1};
    samples.values = model.values("u");
    const double predicted = pi / std::asin(0.6 / 2);  // 2 π / kc on the grid.
    EXPECT_NEAR(measure::measure(samples).wavelength / predicted, 1, 0.03);
    EXPECT_NEAR(predicted / (2 * pi / 0.6), 1, 0.02);
    // The amplitude of a roll, √(4 r / 3).
    EXPECT_NEAR(model.largest("u"), std::sqrt(4 * 0.2 / 3), 0.15);
}

/// A shock from 1 to 0 moves at the speed 1/2, the mean of both values. Its slope in the middle is
/// (Δu)² / (8 ν).
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

/// Bands of bushes move uphill, against the water, which flows towards x = 0.
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

/// For the zebra of A. Witkin and M. Kass (1991), the longest stable step of Euler's method is 2 /
/// (4 (a11 + a22) + b) = 0.0769.
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
