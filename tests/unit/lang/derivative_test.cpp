// Derivatives compared with differences of the rates, and bounds of the Jacobian compared with
// known eigenvalues.
#include "lang/calculus/derivative.h"

#include "lower_helpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

/// A stage on a small grid. From its first to its last column, u goes from 0.2 to 1.4 and v from 2
/// to 0.5.
std::unique_ptr<Checked> rates_of(const std::string& statements) {
    auto checked = check_text("system s {\n u: 0.2 + 1.2 * sx\n v: 2 - 1.5 * sx\n k: 3\n" +
                              statements + "\n}\nstage one: s { }\ndomain { grid: 16, 4 }\n");
    EXPECT_TRUE(checked->program) << statements << checked->faults().front();
    return checked;
}

void shift(Field& field, float by) {
    for (std::int64_t j = 0; j < field.layout().height; ++j) {
        for (std::int64_t i = 0; i < field.layout().width; ++i) field.at(i, j) += by;
    }
}

/// Item 0 and species 0 are u. Item 1 and species 1 are v.
void expect_derivatives(const std::string& rate) {
    const auto checked = rates_of(" u' = " + rate + "\n v' = k * u\n");
    const Program& program = *checked->program;
    ScriptRun run(program);
    run.start(0);
    const ItemId u(0), v(1);
    const auto jacobian = local_jacobian(program, 0);
    ASSERT_TRUE(jacobian) << rate;
    for (const ItemId by : {u, v}) {
        const Formula derivative =
            jacobian->algebra.formula(jacobian->rows[SpeciesId(0)][SpeciesId(by.index())]);
        const Field found = std::move(run.view(derivative, 0)[0]);
        Field& species = run.field(0, by == u ? "u" : "v");
        constexpr float h = 0.005f;
        shift(species, h);
        const Field above = std::move(run.rates(0)[0]);
        shift(species, -2 * h);
        const Field below = std::move(run.rates(0)[0]);
        shift(species, h);
        for (std::int64_t i = 0; i < 16; ++i) {
            const double difference = (double{above.at(i, 0)} - below.at(i, 0)) / (2 * h);
            EXPECT_NEAR(found.at(i, 0), difference, 2e-3 * (1 + std::abs(difference)))
                << rate << " by " << by.index() << ", column " << i;
        }
    }
}

TEST(Derivative, AgreesWithDifferences) {
    for (const char* rate : {"3",
                             "u",
                             "-u * v",
                             "u^2 * v - k * u",
                             "(u + v) / (1 + u * v)",
                             "u^3",
                             "u^-2",
                             "u^1.5",
                             "u^v",
                             "2^u",
                             "exp(-u) * v",
                             "log(u) + sqrt(v)",
                             "sin(u) * cos(v)",
                             "tan(0.5 * u)",
                             "tanh(u - v)",
                             "asin(0.5 * u) + acos(0.3 * v)",
                             "atan(u * v)",
                             "atan2(u, v)",
                             "sinh(u) - cosh(v)",
                             "cbrt(u) * hypot(u, v)",
                             "abs(u - 5) * abs(v)",
                             "min(u, 5) + max(v, 9)",
                             "clamp(u, 0, 3) * clamp(v, 3, 4)",
                             "mix(u, v, 0.25)",
                             "mix(1, 2, u)",
                             "smoothstep(0, 3, u)",
                             "if(k > 2, u * v, 7)",
                             "pow(u, 2)",
                             "mod(u, 50) + floor(v * 0.1)",
                             "u * random(1, 0)",
                             "x * u + y * v",
                             "k^2 * u / (k + u^2)"}) {
        expect_derivatives(rate);
    }
}

TEST(Derivative, GoesThroughDefinitionsAndRates) {
    expect_derivatives("w * w\n w = u * v + q\n q = exp(-u)");
    expect_derivatives("v' + u^2");
}

/// The two formulas of the bound without their aggregates: the largest value of each over all
/// cells, at the start.
std::pair<double, double> bound_at_start(const Checked& checked) {
    const Program& program = *checked.program;
    ScriptRun run(program);
    run.start(0);
    const auto bound = jacobian_bound(program, 0);
    EXPECT_TRUE(bound);
    if (!bound) return {};
    const auto largest = [&](Formula formula) {
        if (formula.nodes.back().function == Function::domain_max) formula.nodes.pop_back();
        const Field field = std::move(run.view(formula, 0)[0]);
        double most = 0;
        for (std::int64_t i = 0; i < field.layout().width; ++i) {
            most = std::max(most, double{field.at(i, 0)});
        }
        return most;
    };
    return {largest(bound->whole), largest(bound->reaction)};
}

TEST(JacobianBound, IsTheSpectrumOfDiffusion) {
    // On a plane the eigenvalues of lap reach −8.
    const auto [whole, reaction] =
        bound_at_start(*rates_of(" u' = 0.25 * lap(u)\n v' = k * lap(v)\n"));
    EXPECT_DOUBLE_EQ(whole, 24);
    EXPECT_DOUBLE_EQ(reaction, 0);
}

TEST(JacobianBound, AddsReactionToDiffusion) {
    const auto [whole, reaction] =
        bound_at_start(*rates_of(" u' = -2 * u - v + lap(u)\n v' = u\n"));
    EXPECT_DOUBLE_EQ(whole, 11);
    EXPECT_DOUBLE_EQ(reaction, 3);
}

TEST(JacobianBound, TellsDiffusionFromWhatMayGrow) {
    // Cahn and Hilliard's lap of lap reaches 64 and makes all waves decay. dx makes waves travel.
    const auto [whole, reaction] =
        bound_at_start(*rates_of(" w = 0.5 * lap(u)\n u' = -lap(w)\n v' = 2 * dx(v) + dxx(v)\n"));
    EXPECT_DOUBLE_EQ(whole, 32);
    EXPECT_DOUBLE_EQ(reaction, 2);
    // With the opposite sign, lap of lap and dxx make waves grow.
    const auto [all, growth] =
        bound_at_start(*rates_of(" w = 0.5 * lap(u)\n u' = lap(w)\n v' = -dxx(v)\n"));
    EXPECT_DOUBLE_EQ(all, 32);
    EXPECT_DOUBLE_EQ(growth, 32);
}

TEST(JacobianBound, GoesThroughFluxesAndTensors) {
    const auto [whole, reaction] = bound_at_start(
        *rates_of(" u' = diffuse(u, 2, 1, 0.3) - u\n v' = div(tensor(2, 1, 0.3) * grad(v))\n"));
    EXPECT_NEAR(whole, 4 * (4 + 1) + 1, 1e-4);
    EXPECT_DOUBLE_EQ(reaction, 1);
    const auto [of_fluxes, of_upwind] =
        bound_at_start(*rates_of(" u' = div(k * grad(u))\n v' = -advect(2, 1, v)\n"));
    EXPECT_DOUBLE_EQ(of_fluxes, 24);
    EXPECT_DOUBLE_EQ(of_upwind, 3);
}

TEST(JacobianBound, GoesThroughDefinitionsThatAreVectors) {
    const auto written = bound_at_start(
        *rates_of(" u' = -div(-k * grad(v)) + dx(u) * v\n v' = div(k * grad(v)) - u\n"));
    const auto defined =
        bound_at_start(*rates_of(" u' = -div(J) + dot(grad(u), w)\n v' = div(k * slope) - u\n"
                                 " J = -k * slope\n slope = grad(v)\n w = vector(v, 0)\n"));
    EXPECT_EQ(defined, written);
    const auto [all, growth] =
        bound_at_start(*rates_of(" u' = -transport(2, 1, u)\n v' = -transport(vector(2, 1), v)\n"));
    EXPECT_DOUBLE_EQ(all, 2 * 2 * (2 + 1));
    EXPECT_DOUBLE_EQ(growth, 2 * (2 + 1));
}

/// The wave that a tensor in space damps most decays at the rate of the bound.
TEST(JacobianBound, OfATensorInSpaceIsSharp) {
    const auto checked = check_text(
        "system s {\n u: x\n u' = div(symmetric(1, 1, 1, 1, 1, 1) * grad(u))\n}\n"
        "stage one: s { }\ndomain { grid: 6, 6, 6 }\n");
    ASSERT_TRUE(checked->program) << checked->faults().front();
    const auto [whole, reaction] = bound_at_start(*checked);
    EXPECT_DOUBLE_EQ(whole, 4 * 3 * 9.0 / 8);
    EXPECT_DOUBLE_EQ(reaction, 0);
    // Waves of 1/3 of a cycle in each cell along all axes: s² = sin²(π/3) = 3/4.
    ScriptRun run(*checked->program);
    run.start(0);
    Field& u = run.field(0, "u");
    const auto wave = [](std::int64_t i, std::int64_t j, std::int64_t k) {
        return static_cast<float>(
            std::cos(2 * std::numbers::pi / 3 * static_cast<double>(i + j + k)));
    };
    for (std::int64_t k = 0; k < 6; ++k) {
        for (std::int64_t j = 0; j < 6; ++j) {
            for (std::int64_t i = 0; i < 6; ++i) u.at(i, j, k) = wave(i, j, k);
        }
    }
    const Field rate = std::move(run.rates(0)[0]);
    EXPECT_NEAR(rate.at(0, 0, 0), -4 * 3 * 9.0 / 8, 1e-4);
}

TEST(JacobianBound, KnowsOfThresholds) {
    const auto jumps = [](const std::string& rate) {
        return jacobian_bound(*rates_of(" u' = " + rate + "\n v' = lap(v)\n")->program, 0)->jumps;
    };
    EXPECT_TRUE(jumps("k * (u > 0.5) - u"));
    EXPECT_TRUE(jumps("if(u - v > 0, u, v)"));
    EXPECT_TRUE(jumps("lap(u) + floor(u * 5)"));
    EXPECT_TRUE(jumps("div(step(0.5, v) * grad(u))"));
    EXPECT_FALSE(jumps("if(x > 0.5, u, v) + max(u, v) + abs(u)"));
    EXPECT_FALSE(jumps("u * step(0.5, k)"));
}

TEST(JacobianBound, IsThatOfTuringsSpots) {
    // Row of a: |ka b| + |ka a| + 8 diff_a; of b: |ka (a − 1)| + |ka b| + 8 diff_b, at a = b = 4.
    const auto checked =
        check_text("stage one: turing_spots { beta: 12 }\ndomain { grid: 16, 16 }");
    const auto [whole, reaction] = bound_at_start(*checked);
    EXPECT_NEAR(whole, 8.0 / 80 + 1, 1e-6);
    EXPECT_NEAR(reaction, 8.0 / 80, 1e-6);
}

TEST(JacobianBound, IsEmptyWhereThereIsNoRule) {
    const auto checked = rates_of(" u' = smoothstep(u, 3, 0.5)\n v' = v\n");
    EXPECT_FALSE(jacobian_bound(*checked->program, 0));
    EXPECT_TRUE(jacobian_bound(*rates_of(" u' = smoothstep(k, 4, x)\n v' = v\n")->program, 0));
}

TEST(JacobianBound, OfLongFormulasIsFound) {
    std::string rate = "u";
    for (int n = 0; n < 3000; ++n) rate += " * 0.999 + u";
    EXPECT_TRUE(jacobian_bound(*rates_of(" u' = " + rate + "\n v' = v\n")->program, 0));
}

}  // namespace
}  // namespace cascade::test
