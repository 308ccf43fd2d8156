// Convolutions, compared with sums that are written out cell by cell.
#include "solvers/convolution.h"

#include "core/plane.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace cascade {
namespace {

using Values = std::vector<double>;  ///< In order of cells.

/// Numbers without a pattern, from −1 to 1.
double scattered(std::int64_t n) { return std::sin(12.9898 * static_cast<double>(n * n + n)); }

std::optional<std::int64_t> place(std::int64_t at, std::int64_t cells, Boundary boundary) {
    if (boundary == Boundary::periodic) return (at % cells + cells) % cells;
    return at >= 0 && at < cells ? std::optional(at) : std::nullopt;
}

Values by_definition(const Grid& grid, const WeightedLags& weighted, const Values& of) {
    Values sums;
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                double sum = 0;
                for (std::size_t n = 0; n < weighted.lags.size(); ++n) {
                    const Lag& lag = weighted.lags[n];
                    const auto x = place(i + lag.x, grid.width, grid.boundary.x);
                    const auto y = place(j + lag.y, grid.height, grid.boundary.y);
                    const auto z = place(k + lag.z, grid.depth, grid.boundary.z);
                    if (!x || !y || !z) continue;
                    const std::int64_t cell = (*z * grid.height + *y) * grid.width + *x;
                    sum += weighted.weights[n] * of[static_cast<std::size_t>(cell)];
                }
                sums.push_back(sum);
            }
        }
    }
    return sums;
}

template <typename Number>
Values by_runner(const Grid& grid, const WeightedLags& weighted, const Values& of, int threads) {
    const PlaneLayout layout(grid);
    Plane<Number> from(layout), to(layout);
    std::size_t cell = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            from.origin()[layout.row_start(row) + i] = static_cast<Number>(of[cell++]);
        }
    }
    ConvolutionRunner<Number> runner(grid, weighted);
    Team team(threads);
    team.run([&](int index) { runner.apply(team, index, threads, from.origin(), to.origin()); });
    Values sums;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            sums.push_back(static_cast<double>(to.origin()[layout.row_start(row) + i]));
        }
    }
    return sums;
}

std::vector<Grid> grids() {
    constexpr Boundary round = Boundary::periodic, ends = Boundary::no_flux;
    return {Grid{40, 1, {round, round, round}, 1},  Grid{37, 1, {ends, ends, ends}, 1},
            Grid{24, 18, {round, round, round}, 1}, Grid{23, 19, {ends, ends, ends}, 1},
            Grid{21, 16, {round, ends, round}, 1},  Grid{9, 8, {ends, round, ends}, 7},
            Grid{8, 10, {round, round, round}, 6},  Grid{1, 30, {ends, round, ends}, 1}};
}

WeightedLags scattered_weights(const Grid& grid, std::optional<double> reach) {
    WeightedLags weighted{*lags_within(grid, reach), {}};
    for (std::size_t n = 0; n < weighted.lags.size(); ++n) {
        weighted.weights.push_back(scattered(static_cast<std::int64_t>(n) + 7));
    }
    return weighted;
}

Values scattered_values(const Grid& grid) {
    Values values;
    for (std::int64_t n = 0; n < grid.cell_count(); ++n) values.push_back(scattered(n));
    return values;
}

TEST(Convolution, IsTheSumThatItsDefinitionSays) {
    // A reach of 1.5 has few lags, which are summed directly. A reach of 30 goes around periodic
    // axes more than once.
    for (const std::optional<double> reach :
         {std::optional(1.5), std::optional(4.2), std::optional(30.0), std::optional<double>()}) {
        for (const Grid& grid : grids()) {
            const WeightedLags weighted = scattered_weights(grid, reach);
            const Values of = scattered_values(grid);
            const Values expected = by_definition(grid, weighted, of);
            const Values found = by_runner<double>(grid, weighted, of, 1);
            const Values rounded = by_runner<float>(grid, weighted, of, 1);
            const double scale = std::sqrt(static_cast<double>(weighted.lags.size()));
            for (std::size_t n = 0; n < expected.size(); ++n) {
                ASSERT_NEAR(found[n], expected[n], 1e-13 * scale) << grid.width << " " << n;
                ASSERT_NEAR(rounded[n], expected[n], 3e-6 * scale) << grid.width << " " << n;
            }
        }
    }
}

TEST(Convolution, HasTheSameBitsWithAnyNumberOfThreads) {
    for (const double reach : {1.0, 5.0}) {
        for (const Grid& grid : grids()) {
            const WeightedLags weighted = scattered_weights(grid, reach);
            const Values of = scattered_values(grid);
            const Values alone = by_runner<float>(grid, weighted, of, 1);
            for (const int threads : {2, 3, 5}) {
                EXPECT_EQ(by_runner<float>(grid, weighted, of, threads), alone);
            }
        }
    }
}

TEST(Convolution, CountsEachCellOfTheDomainOnceWithoutReach) {
    for (const Grid& grid : grids()) {
        WeightedLags weighted{*lags_within(grid, std::nullopt), {}};
        weighted.weights.assign(weighted.lags.size(), 1);
        const Values ones(static_cast<std::size_t>(grid.cell_count()), 1);
        for (const double sum : by_definition(grid, weighted, ones)) {
            EXPECT_EQ(sum, static_cast<double>(grid.cell_count()));
        }
    }
}

TEST(Convolution, LagsEndAtTheReach) {
    const Grid grid{64, 64};
    for (const double reach : {0.0, 1.0, 2.5, 10.0}) {
        std::size_t within = 0;
        for (int y = -10; y <= 10; ++y) {
            for (int x = -10; x <= 10; ++x) within += x * x + y * y <= reach * reach;
        }
        EXPECT_EQ(lags_within(grid, reach)->size(), within);
    }
    Grid wide = grid;
    wide.spacing = 0.5;
    EXPECT_EQ(lags_within(wide, 1.0)->size(), 13u);
    EXPECT_FALSE(lags_within(grid, 1e9));
}

TEST(Convolution, IsAbandonedWhenTheRunIsCancelled) {
    const Grid grid = grids()[2];
    const std::atomic<bool> cancel = true;
    for (const std::optional<double> reach : {std::optional(1.5), std::optional<double>()}) {
        ConvolutionRunner<float> runner(grid, scattered_weights(grid, reach));
        Plane<float> from{PlaneLayout(grid)}, to{PlaneLayout(grid)};
        Team team(2);
        EXPECT_FALSE(complete([&] {
            team.run([&](int index) {
                runner.apply(team, index, 2, from.origin(), to.origin(), &cancel);
            });
        }));
    }
}

}  // namespace
}  // namespace cascade
