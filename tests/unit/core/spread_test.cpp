#include "core/spread.h"

#include <gtest/gtest.h>

#include <limits>
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
    EXPECT_FALSE(spread.is_even());
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
    EXPECT_TRUE(of({}).is_even());
    EXPECT_TRUE(of({3, 3}).is_even());
    EXPECT_TRUE(of({1, 1 + 9e-8}).is_even());
    EXPECT_TRUE(of({1e-38, 5e-38}).is_even());
    EXPECT_FALSE(of({1, 1.0001}).is_even());
    EXPECT_FALSE(of({1e-9, 2e-9}).is_even());
}

}  // namespace
}  // namespace cascade
