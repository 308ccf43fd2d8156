// The settings of time: their values in the program, and defaults.
// tests/scripts/settings/time.cascade tests wrong settings.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

using ::testing::IsEmpty;

constexpr const char* decay = "system decay { u: 1; k: 2; u' = lap(u) - k * u }\n";

/// A stage of a small system. Its statements are on line 2 and begin in column 18.
std::unique_ptr<Checked> checked_stage(const std::string& statements) {
    return check_text(std::string(decay) + "stage s: decay { " + statements + " }\n");
}

StageTime time_of(const std::string& statements) {
    const auto checked = checked_stage(statements);
    EXPECT_THAT(checked->faults(), IsEmpty()) << statements;
    return checked->program ? checked->program->stages[0].time : StageTime{};
}

TEST(CheckTime, ByDefaultTheStepIsEulers) {
    const StageTime time = time_of("");
    EXPECT_EQ(time.solver, Solver::euler);
    EXPECT_FALSE(time.has_duration());
    EXPECT_FALSE(time.chooses_steps());
    EXPECT_FALSE(time.until);
    EXPECT_FALSE(time.steady);
    EXPECT_EQ(time.steps_between_looks(), 100);
}

TEST(CheckTime, SettingsAreTakenAsWritten) {
    for (const std::string& name : solver_names()) {
        EXPECT_EQ(name_of(time_of("solver: " + name).solver), name);
    }
    EXPECT_EQ(time_of("tolerance: 1/50").step_tolerance(), 0.02);
    EXPECT_EQ(time_of("solver: rk45; duration: 1").step_tolerance(), 0.0001);
    EXPECT_EQ(time_of("speed: auto; duration: 1").step_tolerance(), 0.001);
    EXPECT_EQ(time_of("speed: auto; duration: 1; largest_step: 1/4").largest_step, 0.25);
    EXPECT_EQ(time_of("duration: 2*50").duration, 100.0);
    EXPECT_EQ(time_of("check: 20; until: steady(0.5)").check, 20);
    EXPECT_EQ(time_of("until: steady(0.5/2)").steady, 0.25);
    EXPECT_TRUE(time_of("until: t > 3 or step > 200").until);
    EXPECT_TRUE(time_of("until: k > 3").until);
    EXPECT_TRUE(time_of("until: mean(u * x over domain) > 3").until);
    EXPECT_TRUE(time_of("speed: auto; duration: 3").automatic_speed);
    EXPECT_FALSE(time_of("speed: 0.1").automatic_speed);
}

TEST(CheckTime, ConditionsReplaceOnlyEndsOfOtherLevels) {
    const auto iterations_of = [](const std::string& system, const std::string& stage) {
        const auto checked =
            check_text("system s { u: 1; u' = -u; iterations: 50; " + system +
                       " }\nsystem derived: s { until: max(u over domain) < 0.1 }\n" + stage);
        EXPECT_THAT(checked->faults(), IsEmpty()) << stage;
        return checked->program ? checked->program->stages[0].iterations : 0;
    };
    const std::string until = "until: max(u over domain) < 0.5";
    EXPECT_EQ(iterations_of(until, "stage a: s { }"), 50);
    EXPECT_EQ(iterations_of("", "stage a: s { " + until + " }"), 1'000'000);
    EXPECT_EQ(iterations_of(until, "stage a: s { " + until + " }"), 1'000'000);
    EXPECT_EQ(iterations_of("", "stage a: derived { }"), 1'000'000);
    EXPECT_EQ(iterations_of("", "stage a: derived { iterations: 7 }"), 7);
}

TEST(CheckTime, HowAStageEnds) {
    const auto end_of = [](const std::string& statements) {
        const auto checked = checked_stage(statements);
        const Stage& made = checked->program->stages[0];
        return std::pair{made.iterations, made.interval};
    };
    EXPECT_EQ(end_of(""), (std::pair<std::int64_t, std::int64_t>{1000, 100}));
    EXPECT_EQ(end_of("duration: 5"), (std::pair<std::int64_t, std::int64_t>{1'000'000'000, 0}));
    EXPECT_EQ(end_of("duration: 5; interval: 7").second, 7);
    EXPECT_EQ(end_of("iterations: 50; every: 2").second, 0);
    EXPECT_EQ(time_of("iterations: 50; every: 2.5").every, 2.5);
    EXPECT_EQ(end_of("until: steady(0.01)").first, 1'000'000);
    EXPECT_EQ(end_of("until: steady(0.01); iterations: 50").first, 50);
    const StageTime adaptive = time_of("solver: rk23; iterations: 50");
    EXPECT_EQ(adaptive.duration_in_steps, 50);
    EXPECT_TRUE(adaptive.chooses_steps());
}

TEST(CheckTime, AStageGoesBeforeItsSystem) {
    const auto checked = check_text(
        "system s { u: 1; u' = -u; solver: rk4; until: steady(0.1); duration: 9; speed: auto\n"
        "tolerance: 0.01; check: 3}\n"
        "stage one: s { }\n"
        "stage two: s { solver: rkl1; iterations: 5; speed: 2; until: t > 1 }\n");
    ASSERT_THAT(checked->faults(), IsEmpty());
    const StageTime& one = checked->program->stages[0].time;
    EXPECT_EQ(one.solver, Solver::rk4);
    EXPECT_EQ(one.steady, 0.1);
    EXPECT_EQ(one.duration, 9);
    EXPECT_TRUE(one.automatic_speed);
    EXPECT_EQ(one.tolerance, 0.01);
    EXPECT_EQ(one.check, 3);
    const StageTime& two = checked->program->stages[1].time;
    EXPECT_EQ(two.solver, Solver::rkl1);
    EXPECT_FALSE(two.steady);
    EXPECT_TRUE(two.until);
    EXPECT_FALSE(two.duration);
    EXPECT_EQ(checked->program->stages[1].iterations, 5);
    EXPECT_FALSE(two.automatic_speed);
}

TEST(CheckTime, WhatReplacesAnEndReplacesBoth) {
    const auto derived =
        check_text("system ticks: turing_spots { duration: 9 }\nstage s: ticks { }\n");
    ASSERT_THAT(derived->faults(), IsEmpty());
    EXPECT_EQ(derived->program->stages[0].time.duration, 9);
    const auto outside =
        check_text(std::string(decay) + "stage s: decay { iterations: 50 }\n", {"duration=7"});
    ASSERT_THAT(outside->faults(), IsEmpty());
    EXPECT_EQ(outside->program->stages[0].time.duration, 7);
    const auto back =
        check_text(std::string(decay) + "stage s: decay { duration: 50 }\n", {"s.iterations=7"});
    ASSERT_THAT(back->faults(), IsEmpty());
    EXPECT_EQ(back->program->stages[0].iterations, 7);
    EXPECT_FALSE(back->program->stages[0].time.duration);
}

TEST(CheckTime, CoarseStarts) {
    EXPECT_EQ(time_of("").coarse, 1);
    EXPECT_EQ(time_of("start: coarse(4)").coarse, 4);
    EXPECT_EQ(time_of("start: coarse(2 * 8)").coarse, 16);
}

}  // namespace
}  // namespace cascade::test
