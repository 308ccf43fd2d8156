// The solver that takes the reaction in each cell implicitly, in scripts: its order, stiff kinetics
// from the literature, and steps that are too long for any explicit solver.
#include "ran_text.h"

#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

namespace cascade {
namespace {

std::string text_of(const std::string& system, const std::string& settings) {
    return fmt::format(
        "system s {{ {} }}\ndomain {{ grid: 16, 1; precision: double }}\nstage a: s {{ {} }}",
        system, settings);
}

Ran run_system(const std::string& system, const std::string& settings) {
    Ran ran = run_text(text_of(system, settings));
    EXPECT_EQ(ran.failure, "") << settings;
    return ran;
}

/// Three substances, one of which is made a hundred million times as fast as another: H. H.
/// Robertson 1966; E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", section
/// IV.1.
constexpr const char* robertson =
    "a: 1; b: 0; c: 0\n"
    "a' = -0.04 * a + 10000 * b * c\n"
    "b' = 0.04 * a - 10000 * b * c - 30000000 * b^2\n"
    "c' = 30000000 * b^2";

TEST(LocalSolver, IsOfSecondOrderWithAReactionAndDiffusion) {
    const std::string brusselator =
        "u: 1 + 0.5 * cos(2 * pi * sx); v: 3\n"
        "u' = 1 + u^2 * v - 4 * u + 0.3 * lap(u) + 0.1 * sin(t)\n"
        "v' = 3 * u - u^2 * v + 0.15 * lap(v)";
    const Ran exact = run_system(brusselator, "solver: rk4; speed: 0.001; iterations: 1000");
    const auto error = [&](int steps) {
        const Ran ran =
            run_system(brusselator,
                       fmt::format("solver: ros2; speed: 1/{}; iterations: {}", steps, steps));
        double most = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            most =
                std::max(most,
                         moments_of_difference(ran.species(k), exact.species(k)).root_mean_square);
        }
        return most;
    };
    const double coarse = error(64), fine = error(128);
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
}

/// Compares with the values of Hairer and Wanner's RADAU5 at t = 40. b decays at a rate of 2200, so
/// an explicit method would need more than 40,000 steps of 10⁻³.
TEST(LocalSolver, SolvesRobertsonsKinetics) {
    const Ran ran =
        run_system(robertson, "solver: ros2; speed: auto; tolerance: 0.0001; duration: 40");
    EXPECT_LT(ran.state().steps, 2500);
    const auto value = [&](std::size_t k) { return ran.species(k).number_at(3, 0); };
    EXPECT_NEAR(value(0), 0.715827, 1e-5);
    EXPECT_NEAR(value(1) / 9.18553e-6, 1, 1e-4);
    EXPECT_NEAR(value(2), 0.284164, 1e-5);
    EXPECT_NEAR(value(0) + value(1) + value(2), 1, 1e-12) << "nothing is lost";
}

/// A. Prothero, A. Robinson 1974: u is drawn to a known solution, here v, in a fraction of a step.
TEST(LocalSolver, TakesStepsThatNoExplicitSolverCan) {
    const std::string drawn = "u: 1.5; v: 1; w: 0; u' = -1000000 * (u - v) - w; v' = -w; w' = v";
    const Ran ran = run_system(drawn, "solver: ros2; speed: 0.05; iterations: 40");
    EXPECT_NEAR(ran.species().number_at(0, 0), std::cos(2.0), 2e-3);
    for (const char* solver : {"rk4", "rkl2"}) {
        const Ran other = run_text(
            text_of(drawn, fmt::format("solver: {}; speed: 0.05; iterations: 40", solver)));
        const bool is_right = other.failure.empty() &&
                              std::abs(other.species().number_at(0, 0) - std::cos(2.0)) < 0.01;
        EXPECT_FALSE(is_right) << solver;
    }
}

/// The method is L-stable: a decay much faster than one step is complete after this step.
TEST(LocalSolver, EndsWhatDecaysFasterThanAStep) {
    const Ran ran = run_system("u: 1; u' = -10000000 * u + 0.1 * lap(u)",
                               "solver: ros2; speed: 1; iterations: 1");
    EXPECT_LT(std::abs(ran.species().number_at(0, 0)), 1e-5);
}

/// At this length of step the equation for u alone is singular, but the equations for u and v
/// together are not.
TEST(LocalSolver, ExchangesEquationsWhereAPivotVanishes) {
    const double growth = 1 / (1 - std::numbers::sqrt2 / 2);
    const Ran ran = run_system(
        fmt::format("u: 1; v: 0.5; u' = {:.17g} * u - 20 * v; v' = 20 * u - 5 * v", growth),
        "solver: ros2; speed: 1; iterations: 1");
    // The two stages k1 and k2 of the step, found by Cramer's rule.
    const double g = 1 - std::numbers::sqrt2 / 2;
    const double a = 1 - g * growth, b = 20 * g, c = -20 * g, d = 1 + 5 * g, det = a * d - b * c;
    const auto solve = [&](double p, double q) {
        return std::pair((d * p - b * q) / det, (a * q - c * p) / det);
    };
    const auto rates = [&](double u, double v) {
        return std::pair(growth * u - 20 * v, 20 * u - 5 * v);
    };
    const auto [f1, f2] = rates(1, 0.5);
    const auto [k1, l1] = solve(f1, f2);
    const auto [g1, g2] = rates(1 + k1, 0.5 + l1);
    const auto [k2, l2] = solve(g1 - 2 * k1, g2 - 2 * l1);
    EXPECT_NEAR(ran.species(0).number_at(0, 0), 1 + 1.5 * k1 + 0.5 * k2, 1e-11);
    EXPECT_NEAR(ran.species(1).number_at(0, 0), 0.5 + 1.5 * l1 + 0.5 * l2, 1e-11);
}

/// The Belousov-Zhabotinsky reaction with parameters that make it stiffer than the one in the
/// library.
TEST(LocalSolver, GrowsTheWavesOfATightExplicitSolver) {
    const std::string system =
        "eps: 0.001; q: 0.002; f: 1.4; u: if(sx < 0.2, 0.8, 0.012); v: 0.012\n"
        "u' = (u - u^2 - f * v * (u - q) / (u + q)) / eps + lap(u)\n"
        "v' = u - v + 0.6 * lap(v)\n u >= 0";
    const Ran exact = run_system(system, "solver: rk45; tolerance: 0.000001; duration: 0.5");
    const Ran ran =
        run_system(system, "solver: ros2; speed: auto; tolerance: 0.001; duration: 0.5");
    EXPECT_LT(3 * ran.state().steps, exact.state().steps);
    for (std::size_t k = 0; k < 2; ++k) {
        const double difference =
            moments_of_difference(ran.species(k), exact.species(k)).root_mean_square;
        EXPECT_LT(difference, 0.01 * moments(exact.species(k)).root_mean_square) << k;
    }
}

}  // namespace
}  // namespace cascade
