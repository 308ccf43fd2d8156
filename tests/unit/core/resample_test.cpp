// Planes on coarser grids.
#include "core/resample.h"

#include <gtest/gtest.h>

#include <vector>

namespace cascade {
namespace {

Grid grid_of(std::int64_t width, std::int64_t height, std::int64_t depth, Boundaries boundary) {
    Grid grid;
    grid.width = width;
    grid.height = height;
    grid.depth = depth;
    grid.boundary = boundary;
    return grid;
}

/// 1 + 2 x + 3 y − z at the cell's centre, in the unit of the fine cells.
template <typename Number>
Plane<Number> slope_on(const Grid& grid) {
    Plane<Number> plane{PlaneLayout(grid)};
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                const auto centre = [&](std::int64_t cell, std::int64_t cells) {
                    return cells == 1 ? 0 : (static_cast<double>(cell) + 0.5) * grid.spacing;
                };
                plane.at(i, j, k) =
                    static_cast<Number>(1 + 2 * centre(i, grid.width) + 3 * centre(j, grid.height) -
                                        centre(k, grid.depth));
            }
        }
    }
    return plane;
}

TEST(Resample, CoarserCellsCoverTheSameDomain) {
    const Grid fine = grid_of(24, 1, 8, Boundary::no_flux);
    const Grid coarse = coarser(fine, 4);
    EXPECT_EQ(coarse.width, 6);
    EXPECT_EQ(coarse.height, 1);
    EXPECT_EQ(coarse.depth, 2);
    EXPECT_EQ(coarse.spacing, 4);
    EXPECT_EQ(coarse.boundary, fine.boundary);
}

TEST(Resample, SlopesAreKeptInside) {
    const std::vector<GridSize> sizes{{16, 12, 1}, {1, 16, 1}, {8, 16, 12}};
    for (const auto& [width, height, depth] : sizes) {
        const Grid fine = grid_of(width, height, depth, Boundary::no_flux);
        const Grid half = coarser(fine, 2);
        Plane<float> coarse = restricted(slope_on<float>(fine), fine, half);
        const Plane<float> expected_coarse = slope_on<float>(half);
        const Plane<float> again = refined(coarse, half, fine, half.boundary);
        const Plane<float> expected = slope_on<float>(fine);
        const auto inside = [](std::int64_t cell, std::int64_t cells) {
            return cells == 1 || (cell > 0 && cell + 1 < cells);
        };
        for (std::int64_t k = 0; k < depth; ++k) {
            for (std::int64_t j = 0; j < height; ++j) {
                for (std::int64_t i = 0; i < width; ++i) {
                    EXPECT_FLOAT_EQ(coarse.at(i / 2, j / 2, k / 2),
                                    expected_coarse.at(i / 2, j / 2, k / 2));
                    if (!inside(i, width) || !inside(j, height) || !inside(k, depth)) continue;
                    EXPECT_NEAR(again.at(i, j, k), expected.at(i, j, k), 1e-4);
                }
            }
        }
    }
}

TEST(Resample, PeriodicSidesAreNeighboursAndMeansAreKept) {
    const Grid fine = grid_of(8, 2, 1, Boundary::periodic);
    const Grid half = coarser(grid_of(8, 2, 1, Boundary::periodic), 2);
    Plane<float> coarse{PlaneLayout(half)};
    for (std::int64_t i = 0; i < 4; ++i) coarse.at(i, 0) = static_cast<float>(i * i);
    const Plane<float> found = refined(coarse, half, fine, half.boundary);
    EXPECT_FLOAT_EQ(found.at(0, 0), 9.0f / 4);  // Between 0 and, beyond the side, 9.
    EXPECT_FLOAT_EQ(found.at(7, 1), 9 - 9.0f / 4);
    double sum = 0;
    for (std::int64_t i = 0; i < 8; ++i) sum += found.at(i, 0);
    EXPECT_FLOAT_EQ(static_cast<float>(sum), 2 * (0 + 1 + 4 + 9));
}

TEST(Resample, ValuesHeldAtASideAreSeen) {
    const Grid fine = grid_of(8, 1, 1, Boundary::no_flux);
    const Grid half = coarser(fine, 2);
    Plane<float> coarse{PlaneLayout(half)};
    for (std::int64_t i = 0; i < 4; ++i) coarse.at(i, 0) = static_cast<float>(2 * i + 1);
    SideRules sides(half.boundary);
    sides.at[0] = {SideKind::fixed, 0, nullptr};
    sides.at[1] = {SideKind::fixed, 8, nullptr};
    const Plane<float> found = refined(coarse, half, fine, sides);
    for (std::int64_t i = 0; i < 8; ++i)
        EXPECT_FLOAT_EQ(found.at(i, 0), static_cast<float>(i) + 0.5f);
}

}  // namespace
}  // namespace cascade
