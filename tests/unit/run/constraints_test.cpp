// Fields of constraints, compared with known solutions: the order of the error where coefficients
// vary. Any number of threads must give the same bits.
#include "run/simulation/simulation.h"

#include "run/script/script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace cascade {
namespace {

using std::numbers::pi;

/// The values of the first species after all stages of a script, row by row.
std::vector<double> final_values(const std::string& text, int threads) {
    Script script = load_script("test", text, ".");
    EXPECT_TRUE(script.program) << script.messages(false) << text;
    if (!script.program) return {};
    const auto simulation = Simulation::create(script, {"interp", 0, threads}).value();
    EXPECT_TRUE(simulation->start_stage(0));
    RunControl control;
    EXPECT_TRUE(
        simulation->advance_stage(0, script.program->stages[0].iterations, control, nullptr));
    std::vector<double> values;
    const Field& field = simulation->state(0).species()[0];
    field.visit([&](const auto& plane) {
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            const auto* const cells = plane.row(row);
            values.insert(values.end(), cells, cells + plane.layout().width);
        }
    });
    return values;
}

/// The error of φ for −∇·(k ∇φ) + φ = ρ on the unit square, with k = 1 + x / 2. ρ is chosen so that
/// the solution is φ = cos(πx) cos(2πy), which has no flux through the sides.
double error_with_constraint(int side) {
    const std::vector<double> found = final_values(
        fmt::format(
            "system s {{\n"
            "  u: 0\n"
            "  k: 1 + x / 2\n"
            "  f: (5 * pi^2 * (1 + x / 2) + 1) * cos(pi * x) * cos(2 * pi * y)"
            " + pi / 2 * sin(pi * x) * cos(2 * pi * y)\n"
            "  0 = div(k * grad(phi)) - phi + f\n"
            "  u' = phi\n"
            "}}\n"
            "domain {{ grid: {0}, {0}; spacing: 1 / {0}; boundary: noflux; precision: double }}\n"
            "stage only: s {{ iterations: 1; speed: 1 }}\n",
            side),
        1);
    double largest = 0;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const double x = (i + 0.5) / side, y = (j + 0.5) / side;
            const double exact = std::cos(pi * x) * std::cos(2 * pi * y);
            const auto cell = static_cast<std::size_t>(j * side + i);
            largest = std::max(largest, std::abs(found[cell] - exact));
        }
    }
    return largest;
}

TEST(Constraints, HaveErrorsOfSecondOrderWhereCoefficientsVary) {
    const double coarse = error_with_constraint(16), fine = error_with_constraint(32),
                 finest = error_with_constraint(64);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
    EXPECT_NEAR(std::log2(fine / finest), 2, 0.05);
    EXPECT_LT(finest, 3e-3);
}

/// The largest residual of the equation 0 = lap(φ) + ρ, with the terms `extra` added, in any cell.
double largest_rest(const std::string& extra, const std::string& domain) {
    const std::vector<double> rest = final_values(
        "system s { u: 0; w: random(0, 1); rho = w - mean(w over domain)\n"
        "  0 = lap(phi) + rho" +
            extra +
            "\n"
            "  u' = lap(phi) + rho" +
            extra +
            "; w' = 0 }\n"
            "domain { " +
            domain +
            "; precision: double }\n"
            "stage only: s { iterations: 1; speed: 1 }\n",
        2);
    double largest = 0;
    for (const double value : rest) largest = std::max(largest, std::abs(value));
    return largest;
}

/// The last row of 500 cells is not full. After the first iteration, the residual is nonzero only
/// where the coefficient varies, and orthogonal to the first residual.
TEST(Constraints, AreSolvedWhereCoefficientsVaryFarFromTheSource) {
    const std::vector<double> rest = final_values(
        "system s {\n"
        "  u: 0\n"
        "  k: 1 + 100 * (y > 0.99) * (random(0, 1) < 0.05)\n"
        "  0 = div(k * grad(phi))\n"
        "  phi.top: fixed(1)\n"
        "  phi.bottom: fixed(0)\n"
        "  u' = div(k * grad(phi))\n"
        "}\n"
        "domain { grid: 128, 128; boundary: noflux }\n"
        "stage only: s { iterations: 1; speed: 1 }\n",
        1);
    double largest = 0;
    for (const double value : rest) largest = std::max(largest, std::abs(value));
    EXPECT_LT(largest, 1e-3);
    EXPECT_GT(largest, 0);
}

TEST(Constraints, AreSolvedOnModels) {
    for (const char* const extra : {"", " - 0.01 * phi", " - 3 * w * phi"}) {
        EXPECT_LT(largest_rest(extra, "surface: torus; cells: 500"), 1e-9) << extra;
    }
    EXPECT_LT(largest_rest("", "surface: creature; cells: 3000"), 1e-9);
}

TEST(Constraints, HaveTheSameBitsWithAnyNumberOfThreads) {
    const std::string masked =
        "system s { u: random(0, 1); k: 1 + 9 * noise(0.2)^2; 0 = div(k * grad(phi)) - 0.01 * phi + u;"
        " E = -grad(phi); u' = div(u * E) }\n"
        "domain { grid: 40, 33; boundary: noflux; mask: disc(0.5, 0.4, 0.35) }\n"
        "stage only: s { iterations: 3; speed: 0.01 }\n";
    const std::string on_model =
        "system s { u: random(0, 1); 0 = lap(phi) - 0.1 * phi + u; u' = phi - u }\n"
        "domain { surface: sphere; cells: 500 }\n"
        "stage only: s { iterations: 3; speed: 0.1 }\n";
    for (const std::string& text : {masked, on_model}) {
        const std::vector<double> alone = final_values(text, 1);
        EXPECT_GT(alone.size(), 0u);
        for (const int threads : {2, 3}) EXPECT_EQ(final_values(text, threads), alone);
    }
}

}  // namespace
}  // namespace cascade
