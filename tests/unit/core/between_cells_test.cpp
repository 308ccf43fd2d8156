// Curves between cells.
#include "core/between_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace cascade {
namespace {

using Cells = std::array<float, cells_between>;

/// The values of a function in six cells, the third of which is at `x`.
template <typename Function>
Cells cells_at(double x, const Function& function) {
    Cells cells{};
    for (std::size_t k = 0; k < cells.size(); ++k) {
        cells[k] = static_cast<float>(function(x + static_cast<double>(k) - 2));
    }
    return cells;
}

TEST(BetweenCells, CurvesGoThroughCellsAndAreExactOnLines) {
    const auto line = [](double x) { return 3 + 0.25 * x; };
    for (double x = -5; x <= 5; ++x) {
        for (const float part : {0.0F, 0.25F, 0.5F, 0.875F}) {
            EXPECT_FLOAT_EQ(value_between(cells_at(x, line), part),
                            static_cast<float>(line(x + static_cast<double>(part))));
        }
    }
    EXPECT_EQ(value_between<float>({9, 7, 1, 5, -2, 0}, 0), 1);
    EXPECT_EQ(value_between<float>({9, 7, 1, 5, -2, 0}, 1), 5);
}

// Waves of 8 cells are reproduced to 2 % of their height, waves of 12 cells to ½ %, for any
// position of the crests.
TEST(BetweenCells, SmoothWavesAreFollowed) {
    const auto most_off = [](double length, double phase) {
        const auto wave = [&](double x) {
            return std::sin(2 * std::numbers::pi * x / length + phase);
        };
        double most = 0;
        for (double x = 0; x < length; x += 0.0625) {
            const double cell = std::floor(x);
            const auto found = value_between(cells_at(cell, wave), static_cast<float>(x - cell));
            most = std::max(most, std::abs(static_cast<double>(found) - wave(x)));
        }
        return most;
    };
    for (double phase = 0; phase < 3.2; phase += 0.1) {
        EXPECT_LT(most_off(8, phase), 0.04) << phase;
        EXPECT_LT(most_off(12, phase), 0.01) << phase;
    }
}

TEST(BetweenCells, EvenStretchesStayEvenBesideAnEdge) {
    for (float part = 0; part <= 1; part += 0.125F) {
        EXPECT_EQ(value_between<float>({0.1F, 0.1F, 0.1F, 0.1F, 0.9F, 0.9F}, part), 0.1F);
        EXPECT_EQ(value_between<float>({0.1F, 0.1F, 0.9F, 0.9F, 0.9F, 0.1F}, part), 0.9F);
    }
}

TEST(BetweenCells, CurvesOfTwoValuesStayBetweenThem) {
    for (unsigned bits = 0; bits < 64; ++bits) {
        Cells cells{};
        for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = bits >> k & 1U ? 0.75F : 0.25F;
        for (float part = 0; part <= 1; part += 0.0625F) {
            const float value = value_between(cells, part);
            EXPECT_TRUE(value >= 0.25F && value <= 0.75F) << bits << ' ' << part << ' ' << value;
        }
    }
}

// A curve leaves the range of the two cells beside it by at most 0.3 times the largest difference
// of neighbouring cells around it.
TEST(BetweenCells, CurvesStayNearTheirCells) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1, 1);
    for (int trial = 0; trial < 20000; ++trial) {
        Cells v{};
        for (float& value : v) value = number(random);
        float step = 0;
        for (std::size_t k = 1; k < v.size(); ++k) step = std::max(step, std::abs(v[k] - v[k - 1]));
        for (float part = 0; part <= 1; part += 0.0625F) {
            const float value = value_between(v, part);
            EXPECT_GE(value, std::min(v[2], v[3]) - 0.3F * step);
            EXPECT_LE(value, std::max(v[2], v[3]) + 0.3F * step);
        }
    }
}

TEST(BetweenCells, CurvesInRangeLeaveTheRangeOfNoFourCells) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> number(0, 1);
    bool differs = false;
    for (int trial = 0; trial < 20000; ++trial) {
        Cells v{};
        for (float& value : v) value = std::pow(number(random), trial % 2 == 0 ? 1.0F : 20.0F);
        const auto [low, high] = std::minmax({v[1], v[2], v[3], v[4]});
        for (float part = 0; part <= 1; part += 0.125F) {
            const float value = value_in_range(v, part);
            ASSERT_TRUE(value >= low && value <= high) << value;
            differs = differs || value != value_between(v, part);
        }
    }
    EXPECT_TRUE(differs);
}

// The limit takes effect at crests only, and makes no kink there.
TEST(BetweenCells, CurvesInRangeRiseWhereValuesRise) {
    const Cells rising = {0, 1, 3, 4, 6, 7}, crest = {0, 3, 5, 5, 3, 0};
    for (float part = 0; part <= 1; part += 0.125F) {
        EXPECT_EQ(value_in_range(rising, part), value_between(rising, part));
        EXPECT_EQ(value_in_range(crest, part), 5);
    }
    EXPECT_GT(value_between(crest, 0.5F), 5.2F);
}

TEST(BetweenCells, NaNIsSeen) {
    for (std::size_t n = 1; n < 5; ++n) {
        Cells v{0, 3, 0, 1, 2, 0};
        v[n] = NAN;
        EXPECT_TRUE(std::isnan(value_in_range(v, 0.5F))) << n;
    }
    EXPECT_TRUE(std::isnan(value_between<float>({0, NAN, 0, 1, 2, 0}, 0.5F)));
    EXPECT_TRUE(std::isnan(value_between<float>({0, 0, 0, NAN, 2, 0}, 0.5F)));
    EXPECT_FALSE(std::isnan(value_between<float>({NAN, 0, 0, 1, 2, 0}, 0.5F)));
}

}  // namespace
}  // namespace cascade
