#include "core/spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cascade {
namespace {

Spread of(const std::vector<double>& values) {
    return spread_of([&](const auto& take) {
        for (const double value : values) take(value);
    });
}

TEST(Spread, MeanDeviationAndEnds) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Spread spread = of({1, nan, 3, std::numeric_limits<double>::infinity(), 8});
    EXPECT_EQ(spread.count, 3);
    EXPECT_DOUBLE_EQ(spread.mean, 4);
    EXPECT_DOUBLE_EQ(spread.deviation(), std::sqrt(26.0 / 3));
    EXPECT_EQ(spread.smallest, 1);
    EXPECT_EQ(spread.largest, 8);
    EXPECT_FALSE(spread.is_uniform());
}

/// Random numbers, some of them not finite unless `are_finite`.
std::vector<float> numbers(std::size_t count, bool are_finite) {
    std::vector<float> values;
    for (std::size_t k = 0; k < count; ++k) {
        const bool is_finite = are_finite || k % 11 != 5;
        values.push_back(is_finite ? 3 + 0.5F * std::sin(static_cast<float>(k * k))
                                   : std::numeric_limits<float>::infinity());
    }
    return values;
}

void expect_same(const Spread& found, const Spread& expected) {
    EXPECT_EQ(found.count, expected.count);
    EXPECT_NEAR(found.mean, expected.mean, 1e-14 * std::abs(expected.mean));
    EXPECT_NEAR(found.squares, expected.squares, 1e-12 * expected.squares);
    EXPECT_EQ(found.smallest, expected.smallest);
    EXPECT_EQ(found.largest, expected.largest);
}

TEST(Spread, OfAdjacentValuesIsThatOfEach) {
    for (const std::size_t count : {0, 1, 15, 16, 17, 100, 257}) {
        for (const bool are_finite : {true, false}) {
            const std::vector<float> values = numbers(count, are_finite);
            const std::vector<double> wide(values.begin(), values.end());
            expect_same(spread_of(std::span(values)), of(wide));
            expect_same(spread_of(std::span(wide)), of(wide));
        }
    }
}

TEST(Spread, LeavesOutValuesThatDoNotCount) {
    const std::vector<float> values = numbers(300, true);
    std::vector<std::uint8_t> counts;
    std::vector<double> counted;
    for (std::size_t k = 0; k < values.size(); ++k) {
        counts.push_back(k % 100 < 60 || k % 7 == 0 ? 1 : 0);
        if (counts.back() != 0) counted.push_back(double{values[k]});
    }
    expect_same(spread_of(std::span(values), counts.data()), of(counted));
}

TEST(Spread, OfBothIsThatOfAll) {
    Spread both = of({1, 2, 10});
    both.add(of({-4, 5}));
    both.add(of({}));
    const Spread all = of({1, 2, 10, -4, 5});
    EXPECT_EQ(both.count, all.count);
    EXPECT_DOUBLE_EQ(both.mean, all.mean);
    EXPECT_DOUBLE_EQ(both.squares, all.squares);
    EXPECT_EQ(both.smallest, -4);
    EXPECT_EQ(both.largest, 10);
    Spread none;
    none.add(all);
    EXPECT_EQ(none.mean, all.mean);
}

TEST(Spread, RoundingAndWhatDiesAwayAreEven) {
    EXPECT_TRUE(of({}).is_uniform());
    EXPECT_TRUE(of({3, 3}).is_uniform());
    EXPECT_TRUE(of({1, 1 + 9e-8}).is_uniform());
    EXPECT_FALSE(of({1, 1.0001}).is_uniform());
    EXPECT_TRUE(of({1e-13, 5e-13}).is_uniform(1));
    EXPECT_FALSE(of({1e-11, 5e-11}).is_uniform(1));
}

TEST(Spread, NoUnitIsTooSmall) {
    for (const double unit : {1e-9, 1e-18, 1e-38, 1e-100}) {
        EXPECT_FALSE(of({unit, 2 * unit}).is_uniform()) << unit;
        EXPECT_TRUE(of({unit, (1 + 9e-8) * unit}).is_uniform()) << unit;
        EXPECT_FALSE(of({unit, (1 + 9e-8) * unit}).is_one_number()) << unit;
    }
}

}  // namespace
}  // namespace cascade
