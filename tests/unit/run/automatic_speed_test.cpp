// Steps and stages from bounds of the Jacobian.
#include "run/automatic_speed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

TEST(AutomaticSpeed, EulerStaysBelowItsLimit) {
    EXPECT_DOUBLE_EQ(choose_step(Solver::euler, {2, 0.5}, 1e4).step, 0.9);
    EXPECT_DOUBLE_EQ(choose_step(Solver::rk4, {2, 0.5}, 1e4).step, 0.9 * 2.785 / 2);
    EXPECT_EQ(choose_step(Solver::euler, {2, 0.5}, 1e4).stages, 0u);
}

TEST(AutomaticSpeed, StabilisedSolversStepAsTheReactionAllows) {
    for (const Solver solver : {Solver::rkl1, Solver::rkl2}) {
        const StepChoice choice = choose_step(solver, {1 + 0.026, 0.026}, 1e4);
        EXPECT_DOUBLE_EQ(choice.step, reaction_part / 0.026);
        EXPECT_GE(0.9 * stability_interval(solver, choice.stages), choice.step * 1.026);
        EXPECT_LT(0.9 * stability_interval(solver, choice.stages - 2), choice.step * 1.026);
    }
}

/// Evaluations of the rates for a unit of time.
double cost(const StepChoice& choice) { return std::max(choice.stages, 1u) / choice.step; }

TEST(AutomaticSpeed, StagesAreTakenWhereTheyPay) {
    for (double reaction = 0.001; reaction < 100; reaction *= 1.07) {
        const RateBounds bounds{1 + reaction, reaction};
        const double euler = cost(choose_step(Solver::euler, bounds, 1e6));
        const StepChoice choice = choose_step(Solver::rkl1, bounds, 1e6);
        const bool is_limited = choice.step * reaction > reaction_part * (1 - 1e-12);
        if (!is_limited || choice.stages > 1) {
            EXPECT_LE(cost(choice), euler * (1 + 1e-12)) << reaction;
        }
        EXPECT_LE(choice.step * reaction, reaction_part * (1 + 1e-12));
        EXPECT_LE(choice.step * bounds.whole,
                  0.9 * stability_interval(Solver::rkl1, choice.stages) * (1 + 1e-12));
    }
    // Euler's steps of 1.8 cost 0.56: a half, a quarter and a tenth of it.
    EXPECT_LT(cost(choose_step(Solver::rkl1, {1, 1.0 / 24}, 1e6)), 0.56 / 2);
    EXPECT_LT(cost(choose_step(Solver::rkl1, {1, 1.0 / 110}, 1e6)), 0.56 / 4);
    EXPECT_LT(cost(choose_step(Solver::rkl1, {1, 1.0 / 700}, 1e6)), 0.56 / 10);
}

TEST(AutomaticSpeed, ThresholdsAreMetByShorterSteps) {
    EXPECT_DOUBLE_EQ(choose_step(Solver::rkl1, {10, 1, true}, 1e4).step, 0.1);
    // Five stages of a step of 0.09 do more than seven of one of 0.1.
    EXPECT_DOUBLE_EQ(choose_step(Solver::rkl1, {300, 1, true}, 1e4).step, 0.09);
    EXPECT_DOUBLE_EQ(choose_step(Solver::euler, {300, 1, true}, 1e4).step, 0.9 * 2 / 300);
}

TEST(AutomaticSpeed, TakesNoMoreStagesThanThereAre) {
    const StepChoice choice = choose_step(Solver::rkl1, {1e9, 1e-3}, 1e6);
    EXPECT_EQ(choice.stages, most_stages);
    EXPECT_LE(choice.step * 1e9, stability_interval(Solver::rkl1, most_stages));
}

TEST(AutomaticSpeed, NeverStepsOverAStage) {
    EXPECT_DOUBLE_EQ(choose_step(Solver::euler, {0, 0}, 10).step, 0.5);
    EXPECT_DOUBLE_EQ(choose_step(Solver::rkl2, {0, 0}, 10).step, 0.5);
    EXPECT_DOUBLE_EQ(choose_step(Solver::rkl2, {NAN, 1}, 10).step, 0.01);
    EXPECT_DOUBLE_EQ(choose_step(Solver::euler, {INFINITY, 1}, 10).step, 0.01);
}

}  // namespace
}  // namespace cascade
