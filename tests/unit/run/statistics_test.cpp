// Statistics of samples, compared with tables and with exact values.
#include "run/commands/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace cascade {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, TheIntervalUsesStudentsDistribution) {
    // For 1 … 5 the deviation is √2.5, and Student's table has 2.776 for 4 degrees of freedom.
    const Statistics five = statistics_of(std::array{1.0, 2.0, 3.0, 4.0, 5.0});
    EXPECT_EQ(five.count, 5U);
    EXPECT_DOUBLE_EQ(five.mean, 3);
    EXPECT_DOUBLE_EQ(five.deviation, std::sqrt(2.5));
    EXPECT_NEAR(five.high - five.mean, 2.776445 * std::sqrt(2.5 / 5), 1e-6);
    EXPECT_DOUBLE_EQ(five.mean - five.low, five.high - five.mean);
    // The table has 12.706 for 1 degree of freedom.
    const Statistics two = statistics_of(std::array{0.0, 2.0});
    EXPECT_NEAR(two.high, 1 + 12.7062, 1e-4);
}

TEST(Statistics, LeavesOutNaN) {
    const Statistics all = statistics_of(std::array{nan, 4.0, nan, 6.0});
    EXPECT_EQ(all.count, 2U);
    EXPECT_DOUBLE_EQ(all.mean, 5);
    EXPECT_DOUBLE_EQ(all.deviation, std::sqrt(2.0));
}

TEST(Statistics, OneNumberHasNoInterval) {
    const Statistics one = statistics_of(std::array{7.0});
    EXPECT_EQ(one.count, 1U);
    EXPECT_DOUBLE_EQ(one.mean, 7);
    EXPECT_TRUE(std::isnan(one.deviation) && std::isnan(one.low) && std::isnan(one.high));
    EXPECT_EQ(statistics_of({}).count, 0U);
    EXPECT_TRUE(std::isnan(statistics_of({}).mean));
}

TEST(Statistics, SmallDifferencesOfLargeNumbersRemain) {
    const Statistics all = statistics_of(std::array{1e9, 1e9 + 1, 1e9 + 2});
    EXPECT_DOUBLE_EQ(all.deviation, 1);
}

}  // namespace
}  // namespace cascade
