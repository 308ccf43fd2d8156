// Tests that a solver which chooses its steps is accurate: where rates become stiff within a stage,
// with time, by growth or at a threshold, it takes steps that are short enough.
#include "ran_text.h"
#include "resumed_run.h"

#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace cascade {
namespace {

/// A script with these rates and one stage of this duration.
std::string script_of_duration(const std::string& rates, double duration,
                               const std::string& settings) {
    return fmt::format(
        "system s {{ {} }}\ndomain {{ grid: 16, 8 }}\nstage a: s {{ duration: {}; {} }}", rates,
        duration, settings);
}

struct StiffCase {
    const char* name;
    const char* rates;
    double duration;
    double reference_tolerance;
};

constexpr StiffCase stiff_cases[] = {
    {"stiff by time",
     "u: 0.3; u' = 300 * smoothstep(4, 5, t) * (0.5 + 0.3 * sx - u) + 0.001 * lap(u); u >= 0; u <= "
     "1",
     6, 1e-6},
    {"stiff by growth",
     "u: 0.002 + 0.001 * random(0, 1); u' = 50 * u^2 * (1 - u) + 0.01 * lap(u); u >= 0; u <= 1", 12,
     1e-6},
    {"stiff beyond a threshold",
     "u: 0.3; v: 0; v' = 1; u' = if(v > 5, 500 * (0.8 - u), 0.01 * (0.3 - u)) + 0.001 * lap(u); u "
     ">= 0; u <= 1",
     6, 1e-5},
    {"a pulse in time", "u: 0; u' = exp(-((t - 50) / 0.05)^2) * 20 - 0.001 * u + 0.001 * lap(u)",
     100, 1e-6},
    {"a pole beside the solution",
     "eps: 0.002; q: 0.002; f: 1.4; u: 0.1; v: 0.1; u' = (u * (1 - u) - f * v * (u - q) / (u + q)) "
     "/ eps + lap(u)\n"
     "v' = u - v + 0.6 * lap(v)",
     0.2, 1e-6},
    {"relaxation oscillations",
     "u: 0.5 + 0.3 * sx; v: 0.1; u' = 50 * (u - u^3 / 3 - v) + 0.1 * lap(u); v' = u + 0.7 - 0.8 * "
     "v",
     7, 1e-6},
};

/// The largest difference of the species' means and deviations, relative to their size.
double difference(const Ran& a, const Ran& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.state().species().size(); ++k) {
        const FieldMoments apart =
            moments_of_difference(a.state().species()[k], b.state().species()[k]);
        largest = std::max(largest, apart.root_mean_square /
                                        moments(b.state().species()[k]).root_mean_square);
    }
    return largest;
}

class AutomaticSteps : public ::testing::TestWithParam<const char*> {};

TEST_P(AutomaticSteps, AgreeWithATightAdaptiveSolver) {
    for (const StiffCase& each : stiff_cases) {
        const Ran exact = run_text(script_of_duration(each.rates, each.duration,
                                                      fmt::format("solver: rk45; tolerance: {}",
                                                                  each.reference_tolerance)));
        const Ran ran =
            run_text(script_of_duration(each.rates, each.duration,
                                        fmt::format("solver: {}; speed: auto", GetParam())));
        EXPECT_EQ(exact.failure, "") << each.name;
        EXPECT_EQ(ran.failure, "") << each.name;
        EXPECT_LT(difference(ran, exact), 0.02) << each.name;
        EXPECT_LT(ran.state().steps, 20000) << each.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Solvers, AutomaticSteps,
                         ::testing::Values("euler", "symplectic", "rk2", "rk4", "rkl1", "rkl2",
                                           "imex", "etdrk4", "gauss", "ros2"),
                         [](const auto& test) { return std::string(test.param); });

TEST(ChosenSteps, AreNoLongerThanTheLargest) {
    for (const char* settings : {"solver: euler; speed: auto", "solver: rkl2; speed: auto",
                                 "solver: rk45", "solver: imex; speed: auto"}) {
        const Ran free = run_text(script_of_duration("u: sx; u' = 0.001 * lap(u)", 100, settings));
        const Ran limited =
            run_text(script_of_duration("u: sx; u' = 0.001 * lap(u)", 100,
                                        std::string(settings) + "; largest_step: 0.5"));
        EXPECT_LT(free.state().steps, 60) << settings;
        EXPECT_GE(limited.state().steps, 200) << settings;
        EXPECT_LT(limited.state().steps, 220) << settings;
    }
}

/// Where no value changes there is no error, and steps grow to the largest length allowed.
TEST(ChosenSteps, AreAsLongAsTheyMayWhereNothingMoves) {
    const Ran ran = run_text(
        script_of_duration("u: 1; u' = 0.1 * lap(u) + 0 * u", 1000, "solver: rkl1; speed: auto"));
    EXPECT_EQ(ran.failure, "");
    EXPECT_LT(ran.state().steps, 40);
}

/// Implicit diffusion uses the coefficient of the present step, not that of the first one.
TEST(ChosenSteps, DoNotShrinkAsDiffusionBecomesFaster) {
    for (const char* solver : {"imex", "etdrk4", "gauss"}) {
        const Ran ran =
            run_text(script_of_duration("u: random(1, 0.5); k = 0.01 + 0.1 * t; u' = k * lap(u)",
                                        200, fmt::format("solver: {}; speed: auto", solver)));
        EXPECT_EQ(ran.failure, "") << solver;
        EXPECT_LT(ran.state().steps, 200) << solver;
    }
}

/// One of the stages of rk45 gives a rate a negative weight. This term must not lift values off the
/// bound of an invariant, or else the error is only of first order in the step.
TEST(Invariants, LeaveAdaptiveSolversTheirOrder) {
    const auto steps = [](const char* tolerance) {
        const Ran ran =
            run_text(fmt::format("system s {{ a: 4; b: 4; beta: 12 + 0.4 * sin(2 * pi * x)\n"
                                 "a' = 0.0125 * (16 - a * b) + 0.125 * lap(a)\n"
                                 "b' = 0.0125 * (a * b - b - beta) + 0.03125 * lap(b)\n b >= 0 }}\n"
                                 "domain {{ grid: 32, 1; precision: double }}\n"
                                 "stage one: s {{ duration: 3000; solver: rk45; tolerance: {} }}",
                                 tolerance));
        EXPECT_EQ(ran.failure, "");
        EXPECT_EQ(ran.state().species()[1].number_at(8, 0), 0) << "a value is held";
        return ran.state().steps;
    };
    EXPECT_LT(steps("0.00001"), 2 * steps("0.001"));
}

/// Invariants hold in every stage of a solver, so that all solvers agree on when a value leaves its
/// bound.
TEST(Invariants, GiveAllSolversTheSolutionOfEuler) {
    const std::string rates =
        "a: 4; b: 4; beta: random(12, 0.1)\n a' = 0.0125 * (16 - a * b) + 0.125 * lap(a)\n"
        "b' = 0.0125 * (a * b - b - beta) + 0.03125 * lap(b)\n b >= 0";
    const auto run = [&](const std::string& settings) {
        return run_text("system s { " + rates + " }\ndomain { grid: 32, 32 }\nstage one: s { " +
                            settings + " }",
                        {fastest_backend().name, 0, 1});
    };
    const Ran euler = run("speed: 0.25; iterations: 24000");
    const double mean = moments(euler.state().species()[1]).mean;
    EXPECT_EQ(euler.failure, "");
    for (const char* settings :
         {"solver: rk2; speed: 1; iterations: 6000", "solver: rk4; speed: 1; iterations: 6000",
          "solver: rk4; speed: 2; iterations: 3000", "solver: rk23; duration: 6000",
          "solver: rkl1; speed: 4; iterations: 1500", "solver: rkl2; speed: 4; iterations: 1500",
          "solver: rkl2; speed: auto; duration: 6000",
          "solver: etdrk4; speed: auto; duration: 6000"}) {
        const Ran ran = run(settings);
        EXPECT_EQ(ran.failure, "") << settings;
        EXPECT_NEAR(moments(ran.state().species()[1]).mean / mean, 1, 0.002) << settings;
    }
}

TEST(Invariants, AStageOfNoLengthEndsAtOnce) {
    for (const char* solver : {"euler", "rk4", "rk23", "rkl1", "rkl2", "imex", "etdrk4", "gauss"}) {
        const Ran ran =
            run_text(script_of_duration("u: sx; u' = lap(u)", 0,
                                        fmt::format("solver: {}; speed: auto", solver)));
        EXPECT_EQ(ran.failure, "") << solver;
        EXPECT_EQ(ran.state().steps, 0) << solver;
        EXPECT_TRUE(ran.state().done) << solver;
    }
}

class ChosenStepsRun : public ResumedRunTest {};

/// Runs are also stopped between two steps at which the error is estimated.
TEST_F(ChosenStepsRun, ResumeWithTheSameBits) {
    for (const char* solver : {"euler", "rk4", "rkl1", "etdrk4"}) {
        const std::string text = script_of_duration(stiff_cases[1].rates, 9,
                                                    fmt::format("solver: {}; speed: auto", solver));
        run_whole(text);
        for (const std::int64_t step : {1, 2, 37, 100, 131}) {
            run_in_two_parts(text, "a", step);
            EXPECT_EQ(bytes("whole/a.u.npy"), bytes("rest/a.u.npy")) << solver << " " << step;
        }
    }
}

}  // namespace
}  // namespace cascade
