// The settings of time: what they become, their defaults, and their wrong forms.
#include "check_helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* decay = "system decay { u: 1; k: 2; u' = lap(u) - k * u }\n";

/// A stage of a small system; its statements are on line 2, from column 18.
std::unique_ptr<Checked> stage(const std::string& statements) {
    return check_text(std::string(decay) + "stage s: decay { " + statements + " }\n");
}
std::vector<std::string> faults(const std::string& statements) {
    return stage(statements)->faults();
}

StageTime time_of(const std::string& statements) {
    const auto checked = stage(statements);
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

TEST(CheckTime, HowAStageEnds) {
    const auto end_of = [](const std::string& statements) {
        const auto checked = stage(statements);
        const Stage& made = checked->program->stages[0];
        return std::pair{made.iterations, made.interval};
    };
    EXPECT_EQ(end_of(""), (std::pair<std::int64_t, std::int64_t>{1000, 100}));
    EXPECT_EQ(end_of("duration: 5"), (std::pair<std::int64_t, std::int64_t>{1'000'000'000, 0}));
    EXPECT_EQ(end_of("duration: 5; interval: 7").second, 7);
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

TEST(CheckTime, WrongSolvers) {
    EXPECT_THAT(faults("solver: eular"),
                ElementsAre("2:26: there is no solver 'eular' | did you mean 'euler'?"));
    EXPECT_THAT(faults("solver: leapfrog"),
                ElementsAre("2:26: there is no solver 'leapfrog' | solvers are euler, symplectic, "
                            "rk2, rk4, rk23, rk45, rkl1, rkl2, imex, imex2, gauss"));
    EXPECT_THAT(faults("solver: 4"),
                ElementsAre("2:26: a solver is one word | solvers are euler, symplectic, rk2, rk4, "
                            "rk23, rk45, rkl1, rkl2, imex, imex2, gauss"));
    EXPECT_THAT(faults("solver: rk4, rk2"), ElementsAre("2:31: 'solver' takes one value"));
    EXPECT_THAT(faults("solver: rk4; solver: rk2"),
                ElementsAre("2:31: 'solver' is given a value twice"));
}

TEST(CheckTime, WrongNumbers) {
    EXPECT_THAT(faults("tolerance: 0"), ElementsAre("2:29: tolerance must be from 1e-07 to 0.1"));
    EXPECT_THAT(faults("duration: -1"),
                ElementsAre("2:28: duration must be from 0 to 1000000000000"));
    EXPECT_THAT(faults("duration: 1; iterations: 3"),
                ElementsAre(
                    "2:31: a stage ends by its iterations or by its duration, not by both | "
                    "leave one of them out"));
    EXPECT_THAT(faults("iterations: 3; duration: 1"),
                ElementsAre(
                    "2:33: a stage ends by its iterations or by its duration, not by both | "
                    "leave one of them out"));
    EXPECT_THAT(faults("check: 0"), ElementsAre("2:25: check must be at least 1"));
    EXPECT_THAT(faults("check: 2.5"), ElementsAre("2:25: check must be a whole number"));
    EXPECT_THAT(faults("tolerance: k").size(), 1u);
}

TEST(CheckTime, WrongConditions) {
    EXPECT_THAT(faults("until: u > 3"),
                ElementsAre("2:25: a stage ends for all cells at once, and this differs by cell | "
                            "take one number of all cells, as in mean(u over domain) > 0.5"));
    EXPECT_THAT(faults("until: x + 2 * t > 3"),
                ElementsAre("2:25: a stage ends for all cells at once, and this differs by cell | "
                            "take one number of all cells, as in mean(u over domain) > 0.5"));
    EXPECT_THAT(faults("until: steady()").size(), 1u);
    EXPECT_THAT(faults("until: steady(1, 2)"),
                ElementsAre("2:25: steady takes one value: the change that counts as none | "
                            "as in steady(0.01)"));
    EXPECT_THAT(faults("until: steady(0)"), ElementsAre("2:32: steady must be from 1e-06 to 0.9"));
}

TEST(CheckTime, CoarseStarts) {
    EXPECT_EQ(time_of("").coarse, 1);
    EXPECT_EQ(time_of("start: coarse(4)").coarse, 4);
    EXPECT_EQ(time_of("start: coarse(2 * 8)").coarse, 16);
    for (const char* wrong : {"1", "3", "128", "0.5", "-2"}) {
        EXPECT_THAT(faults(std::string("start: coarse(") + wrong + ")"),
                    ElementsAre(
                        "2:32: coarse takes 2, 4, 8, … 64 | each grid has cells half as wide "
                        "as the one before it"));
    }
    EXPECT_THAT(faults("start: coarse()"),
                ElementsAre(
                    "2:25: coarse takes one value: how many times as wide cells are | as in "
                    "start: coarse(4)"));
    EXPECT_THAT(faults("start: t"),
                ElementsAre("2:25: a stage starts as its values say, or on coarser "
                            "grids first | as in start: coarse(4)"));
}

TEST(CheckTime, SettingsThatDoNotGoTogether) {
    EXPECT_THAT(faults("solver: rk4; speed: 1 + x"),
                ElementsAre("2:38: with rk4 the speed is the same in all cells | "
                            "euler and symplectic take one that varies"));
    EXPECT_THAT(faults("solver: symplectic; speed: 1 + x"), IsEmpty());
    EXPECT_THAT(faults("speed: auto"),
                ElementsAre("2:25: with 'speed: auto' a stage ends by its duration | "
                            "write duration: … in place of iterations"));
    EXPECT_THAT(faults("speed: auto; duration: 3; k: [speed]"),
                ElementsAre("2:47: stage 's' chooses its steps as it runs: its speed is no number "
                            "that can be read"));
    EXPECT_THAT(faults("speed: auto; duration: 3; until: speed > 2").size(), 1u);
}

}  // namespace
}  // namespace cascade::testing
