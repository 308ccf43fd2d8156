#include "run/stage/not_finite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cascade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

NotFiniteReport report_of(std::int64_t last_finite, std::int64_t step) {
    NotFiniteReport report;
    report.stage = "s";
    report.system = "gs";
    report.species = "u";
    report.place = "column 1, row 2";
    report.use.speed = 4;
    report.found.step = step;
    report.found.last_finite = last_finite;
    return report;
}

TEST(NotFinite, NamesTheStep) {
    EXPECT_EQ(describe(report_of(63, 64)).message,
              "stage 's' (gs): u is not finite any more at column 1, row 2, after step 64");
    EXPECT_EQ(
        describe(report_of(0, 30)).message,
        "stage 's' (gs): u is not finite any more at column 1, row 2, between steps 0 and 30");
    EXPECT_THAT(describe(report_of(7, 7)).message,
                HasSubstr("the starting value of u is not finite"));
}

// If values are checked after every step, the failing step is known, although the values before it
// may not have been kept.
TEST(NotFinite, SaysNothingOfValuesThatWereNotKept) {
    for (const std::int64_t last_finite : {0, 63}) {
        NotFiniteReport report = report_of(last_finite, 64);
        EXPECT_THAT(describe(report).hint, HasSubstr("a smaller grid"));
        report.estimate_at_start.largest_speed = 1.5;
        EXPECT_THAT(describe(report).hint, HasSubstr("try 'speed: 1.4'"));
    }
    NotFiniteReport kept = report_of(63, 64);
    kept.largest_before = 2;
    EXPECT_THAT(describe(kept).hint, HasSubstr("no value was above 2 before that step"));
    kept.largest_before = 1e9;
    EXPECT_THAT(describe(kept).hint, Not(HasSubstr("no value was above")));
}

// At values of 1e20 any reaction looks stiff, so such a state says nothing about stable speeds.
TEST(NotFinite, DoesNotAskAStateThatIsSpoiled) {
    NotFiniteReport report = report_of(63, 64);
    report.largest_at_start = 2;
    report.largest_before = 1e20;
    report.estimate_before.largest_speed = 2.19e-63;
    EXPECT_THAT(describe(report).hint, Not(HasSubstr("largest stable speed")));
    EXPECT_THAT(describe(report).hint,
                HasSubstr("or the steps are too long; 'solver: rk23' chooses"));
    report.estimate_at_start.largest_speed = 1.5;
    EXPECT_THAT(describe(report).hint, HasSubstr("the largest stable speed is about 1.5,"));
    // The stable speed of a state that has only begun to grow is reported.
    report.largest_before = 20;
    report.estimate_before.largest_speed = 0.5;
    EXPECT_THAT(describe(report).hint, HasSubstr("the largest stable speed is about 0.5,"));
}

TEST(NotFinite, KnowsThatAnAdaptiveSolverFollowsWhatGrows) {
    NotFiniteReport report = report_of(63, 64);
    report.use.solver = Solver::rk45;
    report.largest_before = 1e20;
    EXPECT_EQ(describe(report).hint, "the reaction itself grows without bound here");
}

// Steps of rk4 are stable up to 2.785 / 2 times the largest stable step of Euler's method.
TEST(StepAdvice, IsOfTheSolverInUse) {
    StabilityEstimate estimate;
    estimate.largest_speed = 1;
    const auto longest = [&](Solver solver) {
        StepInUse use;
        use.speed = 2;
        use.solver = solver;
        return longest_step(estimate, use);
    };
    EXPECT_EQ(longest(Solver::euler), 1);
    EXPECT_NEAR(*longest(Solver::rk4), 1.3925, 1e-9);
    EXPECT_GT(*longest(Solver::rkl2), 2000);
    EXPECT_EQ(longest(Solver::imex), std::nullopt);
    estimate.largest_speed = 1e-30;
    EXPECT_EQ(longest(Solver::euler), std::nullopt);
}

TEST(StepAdvice, IsAsMuchTimeAsBefore) {
    StepInUse use;
    use.speed = 1;
    use.iterations = 5000;
    EXPECT_EQ(advise(0.207, use),
              "the largest stable speed is about 0.207, and the speed of this stage is 1; try "
              "'speed: 0.19; iterations: 26316'");
    use.diffusion_limits = true;
    EXPECT_THAT(advise(0.207, use),
                HasSubstr("', or longer steps: 'solver: rkl2; speed: auto; duration: 5000'"));
    use.iterations = 0;
    EXPECT_EQ(advise(0.207, use),
              "the largest stable speed is about 0.207, and the speed of this stage is 1; try "
              "'speed: 0.19', or longer steps: 'solver: rkl2; speed: auto'");
    use.speed = NAN;
    EXPECT_EQ(advise(0.207, use),
              "the largest stable speed is about 0.207, and the speed of this stage varies by "
              "cell; try "
              "'speed: 0.19'");
}

}  // namespace
}  // namespace cascade
