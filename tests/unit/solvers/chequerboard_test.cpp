// Measures how much of a field alternates from cell to cell.
#include "solvers/chequerboard.h"

#include "core/hash.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <cmath>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

const auto board = [](auto i, auto j) { return (i + j) % 2 ? -1.0 : 1.0; };

double part(std::int64_t width, std::int64_t height, auto value) {
    return alternating_part(make_field(Grid{width, height, Boundary::periodic}, value));
}

TEST(Chequerboard, OfKnownFields) {
    EXPECT_EQ(part(16, 12, board), 1);
    EXPECT_EQ(part(16, 12, [](auto i, auto j) { return 1e4 + 43 * board(i, j); }), 1);
    EXPECT_EQ(part(16, 12, [](auto, auto) { return 4.0; }), 0);
    EXPECT_EQ(part(16, 12,
                   [](auto i, auto) { return std::sin(0.392699082 * static_cast<double>(i)); }),
              0);
    // The sum of wide stripes and of a chequerboard.
    EXPECT_GT(part(64, 64,
                   [](auto i, auto j) { return 2 * board(i, j) + (i / 8 % 2 ? -1.0 : 1.0); }),
              0.9);
    EXPECT_EQ(alternating_part(Field{}), 0);
}

TEST(Chequerboard, OfStripesOfOneCell) {
    EXPECT_EQ(part(64, 64, [](auto i, auto) { return i % 2 ? 1.0 : 0.0; }), 1);
    EXPECT_EQ(part(64, 64, [](auto, auto j) { return j % 2 ? 1.0 : 0.0; }), 1);
    EXPECT_EQ(part(100, 1, [](auto i, auto) { return i % 2 ? 1.0 : 0.0; }), 1);
}

TEST(Chequerboard, OfDomainsOfOppositePhase) {
    EXPECT_GT(part(256, 256, [](auto i, auto j) { return board(i + i / 20 % 2 + j / 24 % 2, j); }),
              0.6);
}

TEST(Chequerboard, OfAPartOfTheField) {
    for (const int columns : {64, 13}) {
        const auto half = [=](auto i, auto j) {
            return i < columns ? board(i, j) : std::sin(0.4 * static_cast<double>(i));
        };
        EXPECT_GT(part(128, 128, half), 0.8 * columns / 128 - 0.06) << columns;
        EXPECT_LT(part(128, 128, half), 1.2 * columns / 128 + 0.06) << columns;
    }
}

TEST(Chequerboard, OfAPartOfALargeField) {
    for (const std::int64_t rows : {2100, 1050, 60}) {
        const auto upper = [=](auto i, auto j) {
            return j < rows ? board(i, j) : std::sin(0.4 * static_cast<double>(i));
        };
        EXPECT_NEAR(part(4200, 2100, upper), static_cast<double>(rows) / 2100, 0.02) << rows;
    }
}

TEST(Chequerboard, InSpace) {
    Field field{PlaneLayout(Grid{12, 16, Boundaries{}, 8})};
    Field waves{field.layout()};
    for (std::int64_t k = 0; k < 8; ++k) {
        for (std::int64_t j = 0; j < 16; ++j) {
            for (std::int64_t i = 0; i < 12; ++i) {
                field.at(i, j, k) = (i + j + k) % 2 ? 1.0F : 0.0F;
                waves.at(i, j, k) = std::sin(0.8F * static_cast<float>(i + j + k));
            }
        }
    }
    EXPECT_EQ(alternating_part(field), 1);
    EXPECT_EQ(alternating_part(waves), 0);
}

// White noise is no chequerboard, although its neighbours differ strongly.
TEST(Chequerboard, IsNoNoise) {
    for (const std::int64_t width : {3, 4, 6, 10, 20, 64, 300}) {
        for (const std::int64_t height : {1, 2, 4, 7, 64, 200}) {
            for (const std::int64_t first : {0, 1000, 77777}) {
                const auto noise = [=](auto i, auto j) {
                    return 0x1p-32 *
                           pcg4d({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                                  static_cast<std::uint32_t>(first), 7})[0];
                };
                EXPECT_LT(part(width, height, noise), chequerboard_threshold)
                    << width << " × " << height;
            }
        }
    }
}

// A few cells may alternate by chance.
TEST(Chequerboard, OfAFewCellsIsNone) {
    EXPECT_EQ(part(4, 1, board), 0);
    EXPECT_EQ(part(2, 1, board), 0);
    EXPECT_EQ(part(3, 2, board), 0);
    EXPECT_EQ(part(10, 1, board), 1);
}

// Dots of one cell, and the smallest spots that a grid can show.
TEST(Chequerboard, IsNoPatternOfSmallSpots) {
    EXPECT_EQ(part(60, 60, [](auto i, auto j) { return i % 3 == 0 && j % 3 == 0 ? 1.0 : 0.0; }), 0);
    EXPECT_EQ(part(60, 60, [](auto i, auto j) { return i % 4 < 2 && j % 4 < 2 ? 1.0 : 0.0; }), 0);
}

}  // namespace
}  // namespace cascade::test
