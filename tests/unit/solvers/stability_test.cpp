// Estimates of stability, compared with theory and with steps that are really taken.
#include "solvers/stability.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace cascade::test {
namespace {

StepProblem diffusion_rates(const Grid& grid, float diffusion) {
    StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
        results[0] = cell.uniform(0) * cell.laplacian(0);
    });
    problem.passes[0].uniforms = {diffusion};
    return problem;
}

TEST(Stability, DiffusionOnAPlane) {
    const Grid grid{64, 64, Boundary::periodic};
    for (const double level : {1.0, 1e-4, 300.0}) {
        const auto species = only_species(
            make_field(grid, [&](auto i, auto j) { return level * (1 + 0.1 * scatter(i, j)); }));
        const StabilityEstimate estimate = estimate_stability(diffusion_rates(grid, 0.3f), species);
        EXPECT_NEAR(estimate.eigenvalue, -8 * 0.3, 0.02 * 8 * 0.3);
        ASSERT_TRUE(estimate.largest_speed);
        EXPECT_NEAR(*estimate.largest_speed, 2 / (8 * 0.3), 0.02 * 2 / (8 * 0.3));
    }
}

TEST(Stability, DiffusionAlongARow) {
    const Grid grid{200, 1, Boundary::no_flux};
    const auto species = only_species(make_field(grid, scatter));
    const StabilityEstimate estimate = estimate_stability(diffusion_rates(grid, 2), species);
    EXPECT_NEAR(estimate.eigenvalue, -8, 0.01 * 8);
}

TEST(Stability, DiffusionFromZero) {
    const Grid grid{32, 32, Boundary::periodic};
    const auto species = only_species(Field{PlaneLayout(grid)});
    const StabilityEstimate estimate = estimate_stability(diffusion_rates(grid, 1), species);
    EXPECT_NEAR(estimate.eigenvalue, -8, 0.02 * 8);
}

TEST(Stability, ALargeGridIsEstimatedWithFewerIterations) {
    const Grid grid{1100, 900, Boundary::periodic};
    const auto species = only_species(make_field(grid, scatter));
    const StabilityEstimate estimate = estimate_stability(diffusion_rates(grid, 1), species);
    EXPECT_NEAR(estimate.eigenvalue, -8, 0.02 * 8);
}

TEST(Stability, DecayAndGrowth) {
    const Grid grid{8, 8, Boundary::periodic};
    const auto rates = [&](float k) {
        StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
            results[0] = cell.uniform(0) * cell.field(0);
        });
        problem.passes[0].uniforms = {k};
        return problem;
    };
    const auto species = only_species(make_field(grid, scatter));
    const StabilityEstimate decay = estimate_stability(rates(-5), species);
    EXPECT_NEAR(decay.eigenvalue, -5, 1e-3);
    EXPECT_NEAR(decay.largest_speed.value_or(0), 0.4, 1e-4);
    const StabilityEstimate growth = estimate_stability(rates(3), species);
    EXPECT_NEAR(growth.eigenvalue, 3, 1e-3);
    EXPECT_FALSE(growth.largest_speed);
    const StabilityEstimate rest = estimate_stability(rates(0), species);
    EXPECT_EQ(rest.eigenvalue, 0);
    EXPECT_FALSE(rest.largest_speed);
}

TEST(Stability, DecayBesideStrongerGrowth) {
    // x' = 9 x and y' = -2 y: x grows fastest, but steps above 1 make y explode as well.
    const Grid grid{16, 16, Boundary::periodic};
    const StepProblem problem = make_problem(grid, 2, [](const CellView& cell, float* results) {
        results[0] = 9 * cell.field(0);
        results[1] = -2 * cell.field(1);
    });
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto i, auto j) { return 100 + scatter(i, j); }));
    species.push_back(make_field(grid, [](auto i, auto j) { return 0.01 * scatter(j, i); }));
    const StabilityEstimate estimate = estimate_stability(problem, species);
    EXPECT_NEAR(estimate.eigenvalue, 9, 0.01);
    EXPECT_NEAR(estimate.largest_speed.value_or(0), 1, 0.01);
}

TEST(Stability, ADampedOscillation) {
    // Eigenvalues -1 ± 3i: |1 + h(-1 ± 3i)| = 1 at h = 2 / 10.
    const Grid grid{8, 8, Boundary::periodic};
    const StepProblem problem = make_problem(grid, 2, [](const CellView& cell, float* results) {
        const float x = cell.field(0), y = cell.field(1);
        results[0] = -x - 3 * y;
        results[1] = 3 * x - y;
    });
    std::vector<Field> species;
    species.push_back(make_field(grid, scatter));
    species.push_back(make_field(grid, scatter));
    const StabilityEstimate estimate = estimate_stability(problem, species);
    EXPECT_NEAR(estimate.eigenvalue, -1, 0.01);
    EXPECT_NEAR(estimate.largest_speed.value_or(0), 0.2, 0.002);
}

TEST(Stability, FrozenCellsDoNotMove) {
    // Between frozen cells there are two free ones, in which c' = lap c has the eigenvalues -2 ± 1.
    // The infinite rate of a frozen cell must not matter.
    const Grid grid{6, 1, Boundary::no_flux};
    StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
        results[0] = cell.i == 0 ? 1 / (cell.field(0) * 0) : cell.laplacian(0);
    });
    Mask frozen{PlaneLayout(grid)};
    for (const std::int64_t i : {0, 1, 4, 5}) frozen.at(i, 0) = 1;
    const auto species = only_species(make_field(grid, [](auto, auto) { return 1.0; }));
    const StabilityEstimate estimate = estimate_stability(problem, species, &frozen);
    EXPECT_NEAR(estimate.eigenvalue, -3, 1e-3);
    EXPECT_NEAR(estimate.largest_speed.value_or(0), 2.0 / 3, 1e-3);
}

TEST(Stability, AllFrozenOrNotFinite) {
    const Grid grid{4, 4, Boundary::periodic};
    StepProblem problem = diffusion_rates(grid, 1);
    std::vector<Field> species = only_species(make_field(grid, scatter));
    species[0].at(1, 1) = std::numeric_limits<float>::max();
    species[0].at(2, 1) = -std::numeric_limits<float>::max();
    EXPECT_FALSE(estimate_stability(problem, species).largest_speed);
    Mask frozen{PlaneLayout(grid)};
    for (std::int64_t n = 0; n < 16; ++n) frozen.at(n % 4, n / 4) = 1;
    EXPECT_EQ(estimate_stability(problem, species, &frozen).eigenvalue, 0);
}

/// The rates of Turing's system with ka = 1/80. The uniforms are diff_a and diff_b.
void turing_rates(const CellView& cell, float* rates) {
    const float a = cell.field(0), b = cell.field(1), ka = 1.0f / 80;
    rates[0] = ka * (16 - a * b) + cell.uniform(0) * cell.laplacian(0);
    rates[1] = ka * (a * b - b - 12) + cell.uniform(1) * cell.laplacian(1);
}

std::vector<Field> turing_start(const Grid& grid) {
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 2e-3 * scatter(i, j); }));
    species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 2e-3 * scatter(j, i); }));
    return species;
}

TEST(Stability, TuringsChequerboard) {
    // With diff_a = 1/4 the largest stable speed is just below 1: the Jacobian of the chequerboard
    // has -8/4 - 4/80 and -8/16 + 3/80 on the diagonal, and -4/80 and 3/80 beside it.
    const Grid grid{64, 64, Boundary::periodic};
    StepProblem rates = make_problem(grid, 2, turing_rates);
    rates.passes[0].uniforms = {0.25f, 0.0625f};
    const StabilityEstimate estimate = estimate_stability(rates, turing_start(grid));
    const double u = -2 - 4.0 / 80, v = -0.5 + 3.0 / 80;
    const double middle = (u + v) / 2;
    const double eigenvalue = middle - std::sqrt((u - v) * (u - v) / 4 - 4.0 * 3.0 / 80 / 80);
    EXPECT_NEAR(estimate.eigenvalue, eigenvalue, 0.01 * -eigenvalue);
    ASSERT_TRUE(estimate.largest_speed);
    EXPECT_LT(*estimate.largest_speed, 0.995);
    EXPECT_GT(*estimate.largest_speed, 0.96);
}

TEST(Stability, TheEstimateDividesRunsThatDampFromRunsThatExplode) {
    const Grid grid{32, 32, Boundary::periodic};
    const auto largest_chequerboard = [&](double speed) {
        StepProblem step = make_problem(grid, 2, [](const CellView& cell, float* results) {
            float rates[2];
            turing_rates(cell, rates);
            results[0] = cell.field(0) + cell.uniform(2) * rates[0];
            results[1] = cell.field(1) + cell.uniform(2) * rates[1];
        });
        step.passes[0].uniforms = {0.25f, 0.0625f, static_cast<float>(speed)};
        std::vector<Field> species = turing_start(grid);
        advance_quietly(step, {.last_step = 250}, species);
        double sum = 0;
        for (std::int64_t n = 0; n < 1024; ++n) {
            const std::int64_t i = n % 32, j = n / 32;
            sum += ((i + j) % 2 ? -1.0 : 1.0) * species[0].at(i, j);
        }
        return std::abs(sum) / 1024;
    };
    StepProblem rates = make_problem(grid, 2, turing_rates);
    rates.passes[0].uniforms = {0.25f, 0.0625f};
    const auto estimate = estimate_stability(rates, turing_start(grid));
    ASSERT_TRUE(estimate.largest_speed);
    EXPECT_LT(largest_chequerboard(0.97 * *estimate.largest_speed), 1e-6);
    EXPECT_GT(largest_chequerboard(1.03 * *estimate.largest_speed), 1e-3);
}

// v has died out: differences of values of 1e-37 are lost among denormal numbers.
TEST(Stability, OfASpeciesThatHasDiedOut) {
    const Grid grid{32, 32, Boundary::periodic};
    StepProblem rates = make_problem(grid, 2, [](const CellView& cell, float* results) {
        results[0] =
            0.16F * cell.laplacian(0) - cell.field(0) * cell.field(1) + 0.04F * (1 - cell.field(0));
        results[1] = 0.08F * cell.laplacian(1) - 0.1F * cell.field(1);
    });
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto, auto) { return 1.0; }));
    species.push_back(make_field(grid, [](auto, auto) { return 1e-37; }));
    const StabilityEstimate estimate = estimate_stability(rates, species);
    ASSERT_TRUE(estimate.largest_speed);
    EXPECT_NEAR(*estimate.largest_speed, 2 / (8 * 0.16 + 0.04), 0.03);
}

}  // namespace
}  // namespace cascade::test
