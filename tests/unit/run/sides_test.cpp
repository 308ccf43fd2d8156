// Sides of the grid against solutions that are known.
#include "cascade/cascade.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace cascade {
namespace {

std::vector<float> run(const std::string& script, const std::string& shown = "u") {
    Pattern pattern(script);
    EXPECT_TRUE(pattern.ok()) << pattern.messages() << pattern.error() << script;
    if (!pattern.ok()) return {};
    pattern.step(1000000);
    return pattern.values(shown);
}

/// The largest difference from a function of the cell centre's sx, sy, sz.
double error_of(const std::vector<float>& u, std::size_t width, std::size_t height,
                const std::function<double(double, double, double)>& exact) {
    double error = 0;
    for (std::size_t n = 0; n < u.size(); ++n) {
        const std::size_t i = n % width, j = n / width % height, k = n / width / height;
        const std::size_t depth = u.size() / width / height;
        const auto place = [](std::size_t cell, std::size_t cells) {
            return (static_cast<double>(cell) + 0.5) / static_cast<double>(cells);
        };
        const double expected = exact(place(i, width), place(j, height), place(k, depth));
        error = std::max(error, std::abs(u[n] - expected));
    }
    return error;
}

// A straight line is exact on any grid: the error is rounding.
TEST(Sides, StraightLines) {
    const char* heat =
        "system heat {{ u: 0; u' = lap(u) }}\n"
        "domain {{ grid: {}; boundary: noflux }}\n"
        "stage s: heat {{ iterations: {}; speed: {}; {} }}\n";
    const auto fixed = run(
        fmt::format(fmt::runtime(heat), "16", 3000, 0.4, "u.left: fixed(1); u.right: fixed(3)"));
    EXPECT_LT(error_of(fixed, 16, 1, [](double x, double, double) { return 1 + 2 * x; }), 1e-5);
    const auto flux = run(fmt::format(fmt::runtime(heat), "1, 16", 12000, 0.4,
                                      "u.top: flux(-1/8); u.bottom: fixed(2)"));
    EXPECT_LT(error_of(flux, 1, 16, [](double, double y, double) { return 2 * y; }), 1e-4);
    const auto front = run(fmt::format(fmt::runtime(heat), "2, 3, 12", 4000, 0.16,
                                       "u.sides: fixed(9); u.left: noflux; u.right: noflux; "
                                       "u.top: noflux; u.bottom: noflux; u.back: fixed(3)"));
    EXPECT_LT(error_of(front, 2, 3, [](double, double, double z) { return 9 - 6 * z; }), 1e-4);
}

// sin(2x) exp(−2y) solves Laplace's equation. Values that vary along three sides and the slope at
// the fourth give it back, with an error that falls with the square of the cell.
TEST(Sides, ValuesThatVaryAlongThem) {
    std::vector<double> errors;
    for (const int n : {8, 16, 32}) {
        const auto u = run(fmt::format(
            "system heat {{ u: 0; cells: {0}; u' = lap(u)\n"
            "  u.left: fixed(0)\n  u.right: fixed(sin(2) * exp(-2 * y)) }}\n"
            "domain {{ grid: {0}, {0}; boundary: noflux }}\n"
            "stage s: heat {{ iterations: {1}; speed: 0.2\n"
            "  u.top: fixed(sin(2 * x)); u.bottom: flux(-2 * sin(2 * x) * exp(-2) / [cells]) }}\n",
            n, 12 * n * n));
        errors.push_back(error_of(u, static_cast<std::size_t>(n), static_cast<std::size_t>(n),
                                  [](double x, double y, double) {
                                      return std::sin(2 * x) * std::exp(-2 * y);
                                  }));
    }
    RecordProperty("errors", fmt::format("{} {} {}", errors[0], errors[1], errors[2]));
    EXPECT_LT(errors[2], 1e-3);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 1.6) << errors[0] << " " << errors[1];
    EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7) << errors[1] << " " << errors[2];
}

// Decay of modes: exp(−λ t) with the discrete λ. On fixed sides sin fits, on noflux sides cos.
TEST(Sides, ModesDecayAsTheyShould) {
    constexpr double pi = 3.14159265358979;
    const auto u =
        run("system heat { u: sin(pi * sx) * cos(2 * pi * sy) * cos(2 * pi * sz); u' = lap(u) }\n"
            "domain { grid: 12, 10, 8; boundary: noflux, noflux, periodic; left: fixed(0)\n"
            "  right: fixed(0) }\n"
            "stage s: heat { iterations: 100; speed: 0.1 }\n");
    const auto lambda = [](double angle) { return 2 * (1 - std::cos(angle)); };
    const double rate = lambda(pi / 12) + lambda(2 * pi / 10) + lambda(2 * pi / 8);
    const double left = std::pow(1 - 0.1 * rate, 100);
    EXPECT_LT(error_of(u, 12, 10,
                       [&](double x, double y, double z) {
                           return left * std::sin(pi * x) * std::cos(2 * pi * y) *
                                  std::cos(2 * pi * z);
                       }),
              2e-6);
}

// In units of length: half the spacing on twice the cells is the same domain, and what differs
// falls with the square of the spacing. A flux is per unit of length as well.
TEST(Spacing, IsTheUsersUnitOfLength) {
    constexpr double pi = 3.14159265358979;
    std::vector<double> errors;
    for (const int n : {8, 16, 32}) {
        const auto u = run(fmt::format(
            "system heat {{ u: sin(pi * sx); u' = lap(u) }}\n"
            "domain {{ grid: {0}; spacing: 1 / {0}; boundary: noflux; sides: fixed(0) }}\n"
            "stage s: heat {{ iterations: {1}; speed: 0.1 / {1} }}\n",
            n, 4 * n * n));
        errors.push_back(error_of(u, static_cast<std::size_t>(n), 1, [&](double x, double, double) {
            return std::exp(-pi * pi * 0.1) * std::sin(pi * x);
        }));
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << " " << errors[1];
    EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8) << errors[1] << " " << errors[2];
    const auto slope =
        run("system heat { u: 0; u' = lap(u) }\n"
            "domain { grid: 8; spacing: 0.25; boundary: noflux; left: fixed(0)\n"
            "  right: flux(3) }\n"
            "stage s: heat { iterations: 4000; speed: 0.02 }\n");
    EXPECT_LT(error_of(slope, 8, 1, [](double x, double, double) { return 6 * x; }), 1e-4);
}

// The domain's sides hold for all species, a system's for its own, a stage's before both.
TEST(Sides, WhoHasTheLastWord) {
    const std::string heat =
        "system heat { u: 0; v: 0; w: 0\n"
        "  u' = lap(u); v' = lap(v); w' = lap(w)\n"
        "  v.left: fixed(2); w.left: fixed(2) }\n"
        "system derived: heat { w.right: fixed(4) }\n"
        "domain { grid: 8; boundary: noflux; left: fixed(1); sides: fixed(1) }\n";
    const std::string stage = "stage s: heat { iterations: 2000; speed: 0.4; w.sides: fixed(3) }";
    EXPECT_NEAR(run(heat + stage, "u")[0], 1, 1e-5);
    EXPECT_NEAR(run(heat + stage, "v")[0], 2 - 1.0 / 16, 1e-4);
    EXPECT_NEAR(run(heat + stage, "w")[0], 3, 1e-5);
    const std::string derived = "stage s: derived { iterations: 2000; speed: 0.4 }";
    EXPECT_NEAR(run(heat + derived, "w")[0], 2 + 2.0 / 16, 1e-4);
    EXPECT_NEAR(run(heat + derived, "v")[0], 2 - 1.0 / 16, 1e-4);
}

// What flows in stays: Σu grows by the flux at every step, and by nothing where there is none.
TEST(Sides, WhatFlowsInIsThere) {
    const std::string heat =
        "system heat { u: 1 + 0.5 * disc(0.3, 0.3, 0.2); u' = 0.2 * lap(u) }\n"
        "domain { grid: 20, 16; boundary: noflux }\n";
    const auto sum = [](const std::vector<float>& u) {
        double total = 0;
        for (const float value : u) total += value;
        return total;
    };
    const double start = sum(run(heat + "stage s: heat { iterations: 0 }"));
    EXPECT_NEAR(sum(run(heat + "stage s: heat { iterations: 500 }")), start, 1e-2);
    EXPECT_NEAR(sum(run(heat + "stage s: heat { iterations: 500; u.left: flux(0.1) }")),
                start + 500 * 0.2 * 0.1 * 16, 5e-2);
}

}  // namespace
}  // namespace cascade
