// Tests of the lengths of steps and the numbers of stages that are chosen from bounds of the
// Jacobian.
#include "run/stage/automatic_speed.h"

#include "lang/program/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

constexpr double any_length = 1e9;

TEST(AutomaticSpeed, EulerStaysBelowItsLimit) {
    EXPECT_DOUBLE_EQ(safe_step(Solver::euler, {2, 0.5}, any_length).length, 0.9);
    EXPECT_DOUBLE_EQ(safe_step(Solver::rk4, {2, 0.5}, any_length).length, 0.9 * 2.785 / 2);
    EXPECT_EQ(safe_step(Solver::euler, {2, 0.5}, any_length).stages, 0u);
}

TEST(AutomaticSpeed, StabilisedSolversStepAsTheReactionAllows) {
    for (const Solver solver : {Solver::rkl1, Solver::rkl2}) {
        const SafeStep step = safe_step(solver, {1 + 0.026, 0.026}, any_length);
        EXPECT_DOUBLE_EQ(step.length, reaction_part / 0.026);
        EXPECT_GE(0.9 * stability_interval(solver, step.stages), step.length * 1.026);
        EXPECT_LT(0.9 * stability_interval(solver, step.stages - 2), step.length * 1.026);
    }
}

TEST(AutomaticSpeed, ReactionLimitsStepsAsToleranceDoes) {
    constexpr double usual = StageTime::default_automatic_tolerance;
    for (const Solver solver : {Solver::rkl1, Solver::rkl2, Solver::imex, Solver::etdrk4}) {
        EXPECT_EQ(reaction_part_at(solver, usual), reaction_part) << name_of(solver);
        // Halving the step divides the error by 2^k, where k is the order of the estimate.
        const double shorter = usual * std::pow(0.5, order_of_estimate(solver));
        EXPECT_NEAR(reaction_part_at(solver, shorter), reaction_part / 2, 1e-12);
    }
    EXPECT_NEAR(reaction_part_at(Solver::rkl1, 4 * usual), 2 * reaction_part, 1e-12);
    EXPECT_EQ(reaction_part_at(Solver::imex, 0.1), reaction_part);
    EXPECT_LE(reaction_part_at(Solver::rkl1, 0.1), 6);
}

/// The number of evaluations of the rates per unit of time.
double cost(const SafeStep& step) { return std::max(step.stages, 1u) / step.length; }

TEST(AutomaticSpeed, StagesAreTakenWhereTheyPay) {
    for (double reaction = 0.001; reaction < 100; reaction *= 1.07) {
        const RateBounds bounds{1 + reaction, reaction};
        const double euler = cost(safe_step(Solver::euler, bounds, any_length));
        const SafeStep step = safe_step(Solver::rkl1, bounds, any_length);
        const bool is_limited = step.length * reaction > reaction_part * (1 - 1e-12);
        if (!is_limited || step.stages > 1) {
            EXPECT_LE(cost(step), euler * (1 + 1e-12)) << reaction;
        }
        EXPECT_LE(step.length * reaction, reaction_part * (1 + 1e-12));
        EXPECT_LE(step.length * bounds.whole,
                  0.9 * stability_interval(Solver::rkl1, step.stages) * (1 + 1e-12));
    }
    // Euler's steps of 1.8 cost 0.56 evaluations per unit of time.
    EXPECT_LT(cost(safe_step(Solver::rkl1, {1, 1.0 / 8}, any_length)), 0.56 / 2);
    EXPECT_LT(cost(safe_step(Solver::rkl1, {1, 1.0 / 40}, any_length)), 0.56 / 4);
    EXPECT_LT(cost(safe_step(Solver::rkl1, {1, 1.0 / 240}, any_length)), 0.56 / 10);
}

TEST(AutomaticSpeed, TakesNoMoreStagesThanThereAre) {
    const SafeStep step = safe_step(Solver::rkl1, {1e9, 1e-3}, any_length);
    EXPECT_EQ(step.stages, most_stages);
    EXPECT_LE(step.length * 1e9, stability_interval(Solver::rkl1, most_stages));
}

TEST(AutomaticSpeed, StepsAreNoLongerThanWanted) {
    EXPECT_DOUBLE_EQ(safe_step(Solver::euler, {0, 0}, 0.5).length, 0.5);
    EXPECT_DOUBLE_EQ(safe_step(Solver::rkl2, {0, 0}, 0.5).length, 0.5);
    EXPECT_EQ(safe_step(Solver::rkl2, {0, 0}, 0.5).stages, 3u);
    EXPECT_DOUBLE_EQ(safe_step(Solver::imex, {1e6, 0.1}, 7).length, 7);
}

TEST(AutomaticSpeed, StepsOfNoLengthHaveStages) {
    EXPECT_EQ(safe_step(Solver::rkl1, {1, 0.1}, 0).stages, 1u);
    EXPECT_EQ(safe_step(Solver::rkl2, {1, 0.1}, 0).stages, 3u);
}

}  // namespace
}  // namespace cascade
