// Domains of any shape: what solvers and aggregates see of a mask.

#include "mask_runs.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {
namespace {

using testing::run_text;
using testing::sum_of;

/// The slowest mode of a disc without flux decays as exp(-(1.8412 / R)² D t): 1.8412 is the first
/// zero of J₁' (M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, table 9.5).
double decay_in_disc(int side, double radius_in_cells) {
    const double d = 0.2;
    const double rate = std::pow(1.8411838 / radius_in_cells, 2) * d;
    const auto amplitude = [&](double t) {
        const auto ran = run_text(
            fmt::format("domain {{ grid: {0}, {0}; mask: hypot(x - 0.5, y - 0.5) < {1} }}\n"
                        "system heat {{\n  u: x - 0.5\n  u' = {2} * lap(u)\n}}\n"
                        "stage only: heat {{ iterations: {3} }}\n",
                        side, radius_in_cells / side, d, static_cast<int>(t / rate)));
        const Field& u = ran->field("u");
        double sum = 0;
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                sum += static_cast<double>(u.at(i, j)) * ((i + 0.5) / side - 0.5);
            }
        }
        return sum;
    };
    // By then the next mode, of 5.3314, has decayed e⁻⁸ times as much.
    return std::log(amplitude(1.2) / amplitude(2.2));
}

TEST(Mask, TheSlowestModeOfADiscDecaysAsItShould) {
    const double coarse = decay_in_disc(28, 12.25), fine = decay_in_disc(104, 49);
    std::printf("decay of the slowest mode of a disc, theory 1: R = 12.25: %.4f, R = 49: %.4f\n",
                coarse, fine);
    EXPECT_NEAR(coarse, 1, 0.05);
    EXPECT_NEAR(fine, 1, 0.012);
    EXPECT_LT(std::abs(fine - 1), std::abs(coarse - 1));
}

TEST(Mask, AggregatesAreOfTheDomain) {
    const auto ran = run_text(
        "domain { grid: 20, 10; mask: x < 0.25 }\n"
        "system s {\n"
        "  u: 3 + x\n  u' = 0\n"
        "  count: sum(1 over domain)\n  total: sum(u over domain)\n  middle: mean(2 over domain)\n"
        "  mean_x: mean(x over domain)\n  least: min(7 - x over domain)\n"
        "  most: max(x over domain)\n  lowest: min([u] over domain)\n}\n"
        "stage only: s { iterations: 2 }\n");
    ASSERT_EQ(ran->failure, "");
    EXPECT_EQ(ran->number("count"), 50);
    EXPECT_EQ(ran->number("middle"), 2);
    EXPECT_NEAR(ran->number("mean_x"), 0.125, 1e-6);
    EXPECT_NEAR(ran->number("total"), 50 * 3.125, 1e-4);
    EXPECT_NEAR(ran->number("least"), 7 - 0.225, 1e-6);
    EXPECT_NEAR(ran->number("most"), 0.225, 1e-6);
    EXPECT_NEAR(ran->number("lowest"), 3.025, 1e-6);
}

TEST(Mask, MeansInRatesAreOfTheDomain) {
    // The mean flows back, so that it stays what it is.
    const auto ran = run_text(
        "domain { grid: 24, 24; mask: disc(0.5, 0.5, 0.3) }\n"
        "system s {\n  u: 1 + x\n  u' = 1 - u^2 - mean(1 - u^2 over domain)\n}\n"
        "stage only: s { iterations: 50; speed: 0.1 }\n");
    EXPECT_NEAR(sum_of(ran->field("u")) / static_cast<double>(ran->simulation->mask()->cells), 1.5,
                1e-5);
}

/// Whatever formulas are outside, nothing inside knows of it.
TEST(Mask, OutsideMayBeAnything) {
    const auto ran = run_text(
        "domain { grid: 24, 24; mask: x > 0.2 and x < 0.7 }\n"
        "system s {\n  k: 1 / (x > 0.2 and x < 0.7)\n  speed: if(x < 0.2, -1, 0.1)\n"
        "  u: k * sin(9 * x)\n  v: sqrt(x - 0.2)\n"
        "  u' = k * lap(u) + div(k * grad(u)) + log(u + 2)\n  v' = lap(v / k) - 1 / u\n}\n"
        "stage only: s { iterations: 20 }\n");
    EXPECT_EQ(ran->failure, "");
    EXPECT_TRUE(std::isfinite(sum_of(ran->field("u"))));
    EXPECT_TRUE(std::isfinite(sum_of(ran->field("v"))));
}

TEST(Mask, NotANumberIsOutside) {
    const auto ran = run_text(
        "domain { grid: 10, 10; mask: 1 / sqrt(x - 0.5) }\n"
        "system s { u: 1; u' = 0; }\nstage only: s { iterations: 1 }\n");
    EXPECT_EQ(ran->simulation->mask()->cells, 50);
}

TEST(Mask, ADomainHasCells) {
    const auto ran = run_text(
        "domain { grid: 10, 10; mask: x > 2 }\n"
        "system s { u: 1; u' = 0; }\nstage only: s { iterations: 1 }\n");
    EXPECT_NE(ran->failure.find("no cell is inside the mask"), std::string::npos) << ran->failure;
}

TEST(Mask, ASteadyStateIsFoundAsOnTheSmallGrid) {
    const auto steps = [](const char* domain, int longest) {
        const auto ran = run_text(
            fmt::format("domain {{ {} }}\nsystem s {{\n  p: {} * x\n  u: 2 + sin(0.2 * p)\n"
                        "  u' = 0.2 * lap(u) - 0.01 * (u - 2 - p / 16)\n}}\n"
                        "stage only: s {{ until: steady(0.05) }}\n",
                        domain, longest));
        EXPECT_EQ(ran->failure, "");
        return ran->simulation->state(0).steps;
    };
    const auto small = steps("grid: 16, 16; boundary: noflux", 16);
    EXPECT_GT(small, 100);
    EXPECT_LT(small, 100000);
    EXPECT_EQ(steps("grid: 32, 32; mask: x < 0.5 and y < 0.5", 32), small);
}

TEST(Mask, TooLargeAStepIsExplained) {
    const auto ran = run_text(
        "domain { grid: 40, 40; mask: disc(0.5, 0.5, 0.3) }\n"
        "system s {\n  u: sin(40 * x * y)\n  u' = lap(u) - u^3\n}\n"
        "stage only: s { iterations: 4000; speed: 0.3 }\n");
    // Diffusion alone is stable up to 2 / 8; the reaction takes a part of that.
    const std::string words = "the largest stable speed is about ";
    const auto at = ran->failure.find(words);
    ASSERT_NE(at, std::string::npos) << ran->failure;
    const double found = std::stod(ran->failure.substr(at + words.size()));
    EXPECT_GT(found, 0.15);
    EXPECT_LT(found, 0.25);
}

TEST(Mask, AdaptiveStepsAreThoseOfTheSmallGrid) {
    const auto steps = [](const char* domain, const char* p) {
        const auto ran = run_text(fmt::format(
            "domain {{ {} }}\nsystem s {{\n  p: {}\n  u: sin(0.7 * p)\n  u' = lap(u) - u^3\n}}\n"
            "stage only: s {{ solver: rk45; duration: 30 }}\n",
            domain, p));
        EXPECT_EQ(ran->failure, "");
        return ran->simulation->state(0).steps;
    };
    const auto small = steps("grid: 16, 16; boundary: noflux", "16 * x");
    const auto masked = steps("grid: 64, 32; mask: x < 0.25 and y < 0.25", "64 * x");
    EXPECT_NEAR(static_cast<double>(masked), static_cast<double>(small), 1);
}

}  // namespace
}  // namespace cascade
