// Planes whose cells are divided.
#include "core/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(Divided, SidesThatAreNotPeriodicGoOn) {
    Grid grid{.width = 8, .height = 1};
    grid.boundary.x = Boundary::no_flux;
    const Plane<float> plane = plane_of(grid, [](double x, double) { return x; });
    const Plane<float> found = divided(plane, grid, 4);
    EXPECT_FLOAT_EQ(found.at(16, 0), (16 + 0.5F) / 4);
    EXPECT_EQ(found.at(0, 0), plane.at(0, 0));
    EXPECT_EQ(found.at(31, 0), plane.at(7, 0));
    grid.boundary.x = Boundary::periodic;
    EXPECT_GT(divided(plane, grid, 4).at(0, 0), 2);  // Half the way to the last cell.
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
