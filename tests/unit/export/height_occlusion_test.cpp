// How much light of the sky reaches each cell of a height field.
#include "export/height_occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace cascade {
namespace {

std::vector<float> seen(const FlatCells& cells, std::span<const float> heights, int threads = 2) {
    Team team(threads);
    return height_occlusion(cells, heights, team);
}

/// Heights of a function of column and row.
template <typename Function>
std::vector<float> heights_of(const FlatCells& cells, const Function& function) {
    std::vector<float> heights;
    for (std::int64_t j = 0; j < cells.rows; ++j) {
        for (std::int64_t i = 0; i < cells.columns; ++i) {
            heights.push_back(static_cast<float>(function(i, j)));
        }
    }
    return heights;
}

TEST(HeightOcclusion, LevelGroundSeesTheWholeSky) {
    const FlatCells cells{20, 10};
    for (const float part : seen(cells, std::vector<float>(200, 3.0F))) EXPECT_EQ(part, 1);
}

// A wall along y: in the direction φ its distance is d / cos φ.
TEST(HeightOcclusion, AWallHidesWhatIsBelowItsEdge) {
    const FlatCells cells{64, 64, 0.5, {false, false}};
    constexpr double wall = 6;
    const auto heights =
        heights_of(cells, [](std::int64_t i, std::int64_t) { return i >= 40 ? wall : 0.0; });
    const auto parts = seen(cells, heights);
    for (const std::int64_t away : {8, 16, 24}) {
        double expected = 0;
        for (int k = 0; k < 16; ++k) {
            const double cosine = std::cos(2 * std::numbers::pi * k / 16);
            const double rise =
                cosine > 1e-9 ? wall * cosine / (static_cast<double>(away) * cells.side) : 0;
            expected += 1 / (1 + rise * rise) / 16;
        }
        // Near the wall, the size of the cells causes a larger error.
        EXPECT_NEAR(parts[static_cast<std::size_t>(32 * 64 + 40 - away)], expected, 0.03) << away;
    }
    EXPECT_EQ(parts[32 * 64 + 50], 1);  // On top of the wall.
}

TEST(HeightOcclusion, APitIsDarkerTheDeeperItIs) {
    const FlatCells cells{33, 33, 1, {false, false}};
    float last = 1;
    for (const double depth : {1.0, 4.0, 16.0}) {
        const auto heights = heights_of(cells, [&](std::int64_t i, std::int64_t j) {
            return std::hypot(static_cast<double>(i - 16), static_cast<double>(j - 16)) < 4 ? -depth
                                                                                            : 0.0;
        });
        const float middle = seen(cells, heights)[16 * 33 + 16];
        EXPECT_LT(middle, last);
        const double rise = depth / 4.5;  // Approximate, since the wall is a cell wide.
        EXPECT_NEAR(middle, 1 / (1 + rise * rise), 0.12) << depth;
        last = middle;
    }
}

// Shifting a periodic plane only shifts the result.
TEST(HeightOcclusion, SidesThatRepeatAreSeenAcross) {
    FlatCells cells{24, 16};
    const auto at = [](std::int64_t i, std::int64_t j) {
        return ((i % 24 + 24) % 24) < 3 && ((j % 16 + 16) % 16) < 5 ? 4.0 : 0.0;
    };
    const auto here = seen(cells, heights_of(cells, at));
    const auto moved =
        seen(cells,
             heights_of(cells, [&](std::int64_t i, std::int64_t j) { return at(i + 7, j + 3); }));
    for (std::int64_t j = 0; j < 16; ++j) {
        for (std::int64_t i = 0; i < 24; ++i) {
            EXPECT_NEAR(moved[static_cast<std::size_t>(j * 24 + i)],
                        here[static_cast<std::size_t>((j + 3) % 16 * 24 + (i + 7) % 24)], 1e-6);
        }
    }
    EXPECT_LT(here[23], 0.9F);  // The plane repeats: column 0 is next to column 23.
    cells.repeats = {false, false};
    EXPECT_EQ(seen(cells, heights_of(cells, [](std::int64_t i,
                                               std::int64_t) { return i == 0 ? 4.0 : 0.0; }))[23],
              seen(cells, heights_of(cells, [](std::int64_t i, std::int64_t) {
                       return i == 0 ? 4.0 : 0.0;
                   }))[23 + 24]);
}

TEST(HeightOcclusion, WhatIsNotThereHidesNothing) {
    FlatCells cells{9, 9};
    auto heights =
        heights_of(cells, [](std::int64_t i, std::int64_t) { return i == 4 ? 9.0 : 0.0; });
    EXPECT_LT(seen(cells, heights)[3], 0.8F);
    for (std::size_t j = 0; j < 9; ++j) heights[j * 9 + 4] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(seen(cells, heights)[3], 1);
    for (std::size_t j = 0; j < 9; ++j) heights[j * 9 + 4] = 9;
    cells.inside.assign(81, 1);
    for (std::size_t j = 0; j < 9; ++j) cells.inside[j * 9 + 4] = 0;
    EXPECT_EQ(seen(cells, heights)[3], 1);
}

TEST(HeightOcclusion, ThreadsChangeNothing) {
    const FlatCells cells{31, 17};
    const auto heights = heights_of(cells, [](std::int64_t i, std::int64_t j) {
        return std::sin(0.7 * static_cast<double>(i)) * std::cos(0.9 * static_cast<double>(j));
    });
    EXPECT_EQ(seen(cells, heights, 1), seen(cells, heights, 5));
}

}  // namespace
}  // namespace cascade
