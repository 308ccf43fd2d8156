// Sizes of batches, rates and reports, with made-up times.
#include "solvers/pace.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

TEST(Pace, BatchesTakeTwentyMilliseconds) {
    Pace pace(Pace::Time{}, 0);
    EXPECT_EQ(pace.batch(), 1);
    for (int batch = 0; batch < 10; ++batch) {
        pace.took(pace.batch(), duration<double>(static_cast<double>(pace.batch()) * 1e-5));
    }
    EXPECT_NEAR(static_cast<double>(pace.batch()), 2000, 2);
    pace.took(1000, duration<double>(10.0));  // The machine has become slow: 10 ms a step.
    EXPECT_EQ(pace.batch(), 2);
    pace.took(2, duration<double>(10.0));
    EXPECT_EQ(pace.batch(), 1);
}

TEST(Pace, BatchesGrowByStepsAndSurviveAClockThatStands) {
    Pace pace(Pace::Time{}, 0);
    pace.took(1, duration<double>(0));
    EXPECT_EQ(pace.batch(), 8);
    for (int batch = 0; batch < 100; ++batch) pace.took(pace.batch(), duration<double>(0));
    EXPECT_GT(pace.batch(), 1'000'000);
    EXPECT_LE(pace.batch(), 1'000'000'000);
}

TEST(Pace, ReportsTenTimesASecond) {
    Pace pace(Pace::Time{}, 0);
    EXPECT_FALSE(pace.report_due(Pace::Time{} + milliseconds(99)));
    EXPECT_TRUE(pace.report_due(Pace::Time{} + milliseconds(100)));
    pace.reported(Pace::Time{} + milliseconds(130), 10);
    EXPECT_FALSE(pace.report_due(Pace::Time{} + milliseconds(229)));
    EXPECT_TRUE(pace.report_due(Pace::Time{} + milliseconds(230)));
}

TEST(Pace, RateIsThatOfTheLastTwoSeconds) {
    Pace pace(Pace::Time{}, 500);
    EXPECT_EQ(pace.steps_per_second(), 0);
    Pace::Time now{};
    std::int64_t step = 500;
    for (int report = 0; report < 10; ++report) {
        now += milliseconds(100);
        step += 7;
        pace.reported(now, step);
    }
    EXPECT_NEAR(pace.steps_per_second(), 70, 1e-6);
    for (int report = 0; report < 25; ++report) {
        now += milliseconds(100);
        step += 300;
        pace.reported(now, step);
    }
    EXPECT_NEAR(pace.steps_per_second(), 3000, 1e-6);
}

}  // namespace
}  // namespace cascade
