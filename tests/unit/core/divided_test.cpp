// Planes whose cells are divided.
#include "core/resample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace cascade {
namespace {

template <typename Function>
Plane<float> plane_of(const Grid& grid, const Function& function) {
    Plane<float> plane{PlaneLayout(grid)};
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            plane.at(i, j) =
                static_cast<float>(function((static_cast<double>(i) + 0.5) * grid.spacing,
                                            (static_cast<double>(j) + 0.5) * grid.spacing));
        }
    }
    return plane;
}

TEST(Divided, TheDomainStaysAsLarge) {
    const Grid grid{.width = 12, .height = 8, .spacing = 0.5};
    EXPECT_EQ(finer_grid(grid, 4), (Grid{.width = 48, .height = 32, .spacing = 0.125}));
    const Grid line{.width = 12, .height = 1, .spacing = 0.5};
    EXPECT_EQ(finer_grid(line, 2), (Grid{.width = 24, .height = 1, .spacing = 0.25}));
    const Grid column{.width = 1, .height = 12};
    EXPECT_EQ(finer_grid(column, 2), (Grid{.width = 1, .height = 24, .spacing = 0.5}));
    const Grid volume{.width = 4, .height = 3, .depth = 2};
    EXPECT_EQ(finer_grid(volume, 3),
              (Grid{.width = 12, .height = 9, .depth = 6, .spacing = 1.0 / 3}));
}

TEST(Divided, WavesKeepTheirPlaces) {
    const Grid grid{.width = 24, .height = 36, .spacing = 0.5};
    const auto wave = [](double x, double y) {
        return std::sin(2 * std::numbers::pi * x / 6) + std::cos(2 * std::numbers::pi * y / 9);
    };
    const Plane<float> plane = plane_of(grid, wave);
    for (const std::int64_t times : {2, 3, 8}) {
        const Grid finer = finer_grid(grid, times);
        const Plane<float> found = divided(plane, grid, times), wanted = plane_of(finer, wave);
        for (std::int64_t j = 0; j < finer.height; ++j) {
            for (std::int64_t i = 0; i < finer.width; ++i) {
                EXPECT_NEAR(found.at(i, j), wanted.at(i, j), 0.02) << times << ' ' << i << ' ' << j;
            }
        }
    }
}

/// The mean error of a wave along an axis of `cells` cells. The other axes have few cells.
double mean_error(std::int64_t cells, int axis) {
    Grid grid{.width = 3, .height = 3, .depth = 3};
    (axis == 0 ? grid.width : axis == 1 ? grid.height : grid.depth) = cells;
    const auto wave = [](std::int64_t cell, std::int64_t of) {
        return std::sin(2 * std::numbers::pi * (static_cast<double>(cell) + 0.5) /
                        static_cast<double>(of));
    };
    const auto along = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        return axis == 0 ? i : axis == 1 ? j : k;
    };
    Plane<double> plane{PlaneLayout(grid)};
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i)
                plane.at(i, j, k) = wave(along(i, j, k), cells);
        }
    }
    const Plane<double> found = divided(plane, grid, 2);
    const Grid finer = finer_grid(grid, 2);
    double sum = 0;
    for (std::int64_t k = 0; k < finer.depth; ++k) {
        for (std::int64_t j = 0; j < finer.height; ++j) {
            for (std::int64_t i = 0; i < finer.width; ++i)
                sum += std::abs(found.at(i, j, k) - wave(along(i, j, k), 2 * cells));
        }
    }
    return sum / static_cast<double>(finer.cell_count());
}

TEST(Divided, IsOfThirdOrderAlongEachAxis) {
    for (const int axis : {0, 1, 2}) {
        const double ratio = mean_error(32, axis) / mean_error(64, axis);
        EXPECT_GT(std::log2(ratio), 2.8) << axis;
        EXPECT_LT(mean_error(32, axis), 5e-4) << axis;
    }
}

TEST(Divided, SidesThatAreNotPeriodicGoOn) {
    Grid grid{.width = 8, .height = 1};
    grid.boundary.x = Boundary::no_flux;
    const Plane<float> plane = plane_of(grid, [](double x, double) { return x; });
    const Plane<float> found = divided(plane, grid, 4);
    EXPECT_FLOAT_EQ(found.at(16, 0), (16 + 0.5F) / 4);
    EXPECT_EQ(found.at(0, 0), plane.at(0, 0));
    EXPECT_EQ(found.at(31, 0), plane.at(7, 0));
    grid.boundary.x = Boundary::periodic;
    EXPECT_GT(divided(plane, grid, 4).at(0, 0), 2);  // Half way to the value of the last cell.
}

/// Steep random fields of few cells and of single spikes, on a line, in the plane and in a volume.
TEST(Divided, WhatGoesOnStaysInTheRangeOfTheCellsAroundAndKeepsTheMean) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0, 1);
    for (Grid grid : {Grid{.width = 40, .height = 1}, Grid{.width = 1, .height = 40},
                      Grid{.width = 24, .height = 20}, Grid{.width = 9, .height = 7, .depth = 8}}) {
        for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
            grid.boundary = boundary;
            Plane<double> plane{PlaneLayout(grid)};
            double least = 1, sum = 0;
            for (std::int64_t k = 0; k < grid.depth; ++k) {
                for (std::int64_t j = 0; j < grid.height; ++j) {
                    for (std::int64_t i = 0; i < grid.width; ++i) {
                        plane.at(i, j, k) = std::pow(number(random), 8);
                        least = std::min(least, plane.at(i, j, k));
                        sum += plane.at(i, j, k);
                    }
                }
            }
            double smallest_drawn = 1, sum_found = 0;
            const Plane<double> found = divided_in_range(plane, grid, 4),
                                drawn = divided(plane, grid, 4);
            const Grid finer = finer_grid(grid, 4);
            for (std::int64_t k = 0; k < finer.depth; ++k) {
                for (std::int64_t j = 0; j < finer.height; ++j) {
                    for (std::int64_t i = 0; i < finer.width; ++i) {
                        ASSERT_GE(found.at(i, j, k), least);
                        ASSERT_LE(found.at(i, j, k), 1);
                        sum_found += found.at(i, j, k);
                        smallest_drawn = std::min(smallest_drawn, drawn.at(i, j, k));
                    }
                }
            }
            EXPECT_LT(smallest_drawn, least);  // Otherwise this field would test nothing.
            if (boundary != Boundary::periodic) continue;
            const auto finer_cells = static_cast<double>(finer.cell_count()),
                       cells = static_cast<double>(grid.cell_count());
            EXPECT_NEAR(sum_found / finer_cells, sum / cells, 1e-14);
        }
    }
}

TEST(Divided, ByOneIsTheSame) {
    const Grid grid{.width = 5, .height = 4};
    const Plane<float> plane = plane_of(grid, [](double x, double y) { return x * y * y; });
    const Plane<float> found = divided(plane, grid, 1);
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 5; ++i) EXPECT_EQ(found.at(i, j), plane.at(i, j));
    }
}

}  // namespace
}  // namespace cascade
