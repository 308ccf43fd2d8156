// The time loop, compared with the exact solution of the discrete heat equation.
#include "solvers/advance.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace cascade::test {
namespace {

using std::numbers::pi;

/// Eigenfunctions of the discrete Laplacian along one axis, and their eigenvalues.
double wave(Boundary boundary, int mode, std::int64_t cells, std::int64_t i) {
    const auto n = static_cast<double>(cells);
    if (cells == 1) return 1;
    if (boundary == Boundary::periodic) return std::cos(2 * pi * mode * static_cast<double>(i) / n);
    return std::cos(pi * mode * (static_cast<double>(i) + 0.5) / n);
}

double eigenvalue(Boundary boundary, int mode, std::int64_t cells) {
    if (cells == 1) return 0;
    const double angle = (boundary == Boundary::periodic ? 2 : 1) * pi * mode;
    const double sine = std::sin(angle / static_cast<double>(cells) / 2);
    return -4 * sine * sine;
}

struct HeatCase {
    std::int64_t width, height;
    Boundary boundary;
    int column_mode, row_mode;
};

class Heat : public ::testing::TestWithParam<HeatCase> {};

TEST_P(Heat, DecaysAtTheDiscreteRate) {
    const HeatCase& c = GetParam();
    const Grid grid{c.width, c.height, c.boundary};
    const auto mode = [&](std::int64_t i, std::int64_t j) {
        return wave(c.boundary, c.column_mode, c.width, i) *
               wave(c.boundary, c.row_mode, c.height, j);
    };
    constexpr double diffusion = 0.125;  // A power of two, so the coefficient is not rounded.
    constexpr int steps = 150;
    std::vector<Field> species;
    species.push_back(make_field(grid, mode));
    const StageOutcome outcome =
        advance_quietly(heat_problem(grid, diffusion), {.last_step = steps}, species);
    EXPECT_EQ(outcome.steps, steps);
    EXPECT_FALSE(outcome.not_finite);

    double projection = 0, norm = 0;
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            projection += mode(i, j) * species[0].at(i, j);
            norm += mode(i, j) * mode(i, j);
        }
    }
    const double rate = 1 + diffusion * (eigenvalue(c.boundary, c.column_mode, c.width) +
                                         eigenvalue(c.boundary, c.row_mode, c.height));
    const double expected = std::pow(rate, steps);
    EXPECT_NEAR(projection / norm / expected, 1, 1e-5);
    // No other mode has appeared: every cell is the mode times its amplitude.
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            ASSERT_NEAR(species[0].at(i, j), expected * mode(i, j), 1e-5);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Grids, Heat,
    ::testing::Values(
        HeatCase{60, 1, Boundary::periodic, 3, 0}, HeatCase{61, 1, Boundary::no_flux, 2, 0},
        HeatCase{1, 47, Boundary::periodic, 0, 2}, HeatCase{1, 16, Boundary::no_flux, 0, 1},
        HeatCase{64, 64, Boundary::periodic, 2, 3}, HeatCase{37, 53, Boundary::periodic, 1, 4},
        HeatCase{37, 53, Boundary::no_flux, 3, 2}, HeatCase{2, 2, Boundary::no_flux, 1, 0},
        HeatCase{17, 2, Boundary::no_flux, 1, 0}, HeatCase{2, 31, Boundary::periodic, 0, 1}),
    [](const auto& tested) {
        return std::to_string(tested.param.width) + "x" + std::to_string(tested.param.height) +
               (tested.param.boundary == Boundary::periodic ? "_periodic" : "_no_flux");
    });

class Conservation : public ::testing::TestWithParam<Boundary> {};

TEST_P(Conservation, DiffusionKeepsTheSum) {
    const Grid grid{43, 29, GetParam()};
    std::vector<Field> species;
    species.push_back(make_field(grid, scatter));
    const auto sum = [&] {
        double total = 0;
        for (const float value : cells_of(species[0])) total += value;
        return total;
    };
    const double before = sum();
    advance_quietly(heat_problem(grid, 0.2f), {.last_step = 400}, species);
    // 400 roundings of values below 1, in both directions, in each of 1247 cells.
    EXPECT_NEAR(sum(), before, 1e-3);
    EXPECT_NE(sum(), 0);
    // The slowest mode decays with an exponent of at least 400 · 0.2 · (pi/43)^2, so the field is
    // flat.
    const double mean = before / static_cast<double>(grid.cell_count());
    for (const float value : cells_of(species[0])) EXPECT_NEAR(value, mean, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, Conservation,
                         ::testing::Values(Boundary::periodic, Boundary::no_flux));

TEST(Heat, FlatFieldStaysPut) {
    const Grid grid{19, 23, Boundary::no_flux};
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto, auto) { return 4.0; }));
    advance_quietly(heat_problem(grid, 0.25f), {.last_step = 1000}, species);
    for (const float value : cells_of(species[0])) ASSERT_EQ(value, 4.0f);
}

}  // namespace
}  // namespace cascade::test
