// Solvers in scripts: orders, compared with known solutions, stabilised solvers, compared with
// Euler's method, and the same bits after a run is resumed. The bits of all executors, the ends of
// stages and conserved energy are tested in tests/scripts/steps.
#include "ran_text.h"
#include "resumed_run.h"

#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using ::testing::HasSubstr;

/// A system whose solution is u = 1 + cos t · cos 2πx. Diffusion, whose eigenvalue on 16 cells is
/// q, and a source together give this u. (v, w) turns on a circle by the angle sin t.
std::string manufactured(const std::string& settings) {
    return "system made {\n"
           "  u: 1 + cos(2 * pi * x)\n  v: 0\n  w: 1\n"
           "  q = 2 - 2 * cos(2 * pi / 16)\n"
           "  u' = 0.5 * lap(u) + (0.5 * q * cos(t) - sin(t)) * cos(2 * pi * x)\n"
           "  v' = w * cos(t)\n  w' = -v * cos(t)\n}\n"
           "stage s: made {\n" +
           settings + "\n}\ndomain { grid: 16, 1 }\n";
}

double manufactured_error(const Ran& ran) {
    const double t = 2;
    double most = 0;
    for (std::int64_t i = 0; i < 16; ++i) {
        const double x = (static_cast<double>(i) + 0.5) / 16;
        const double u = 1 + std::cos(t) * std::cos(2 * std::numbers::pi * x);
        most = std::max(most, std::abs(ran.state().species()[0].at(i, 0) - u));
        most = std::max(most, std::abs(ran.state().species()[1].at(i, 0) - std::sin(std::sin(t))));
        most = std::max(most, std::abs(ran.state().species()[2].at(i, 0) - std::cos(std::sin(t))));
    }
    return most;
}

double error_of(const std::string& solver, int steps) {
    const Ran ran = run_text(
        manufactured(fmt::format("solver: {}; speed: 2/{}; iterations: {}", solver, steps, steps)));
    EXPECT_EQ(ran.failure, "");
    EXPECT_NEAR(ran.state().t, 2, 1e-5);
    return manufactured_error(ran);
}

TEST(Solvers, OrdersThroughTheLanguage) {
    struct Case {
        const char* solver;
        int steps;
    };
    for (const auto& [solver, steps] :
         {Case{"euler", 64}, Case{"symplectic", 64}, Case{"rk2", 16}, Case{"rk4", 8},
          Case{"rkl1", 64}, Case{"rkl2", 16}, Case{"imex", 64}, Case{"etdrk4", 4},
          Case{"gauss", 64}, Case{"ros2", 32}}) {
        const double order = std::log2(error_of(solver, steps) / error_of(solver, 2 * steps));
        RecordProperty(solver, fmt::format("{:.2f}", order));
        // Steps must be so long that errors exceed the rounding of single precision.
        EXPECT_GT(order, order_of(*solver_of(solver)) - 0.25) << solver;
        EXPECT_LT(order, order_of(*solver_of(solver)) + 0.5) << solver;
    }
}

TEST(Solvers, AdaptiveOnesKeepTheirTolerance) {
    for (const char* solver : {"rk23", "rk45"}) {
        std::int64_t steps_before = 0;
        for (const double tolerance : {1e-2, 1e-5}) {
            const Ran ran = run_text(manufactured(fmt::format(
                "solver: {}; tolerance: {}; duration: 2; speed: 1", solver, tolerance)));
            EXPECT_EQ(ran.failure, "");
            EXPECT_DOUBLE_EQ(ran.state().t, 2);
            EXPECT_LT(manufactured_error(ran), 10 * tolerance) << solver;
            EXPECT_GT(ran.state().steps, steps_before) << solver;
            steps_before = ran.state().steps;
            EXPECT_LT(steps_before, 200) << solver;
        }
    }
}

constexpr const char* frozen_spots =
    "system s {\n a: 4; b: 4; beta: random(12, 0.1)\n a' = 0.05 * (16 - a*b) + 0.125 * lap(a) + "
    "0.001 * sin(t)\n"
    " b' = 0.05 * (a*b - b - beta) + 0.03125 * lap(b)\n b >= 3.9\n}\n";

std::string frozen_script(const std::string& settings) {
    return std::string(frozen_spots) + "stage one: s { frozen: x > 0.8 and y < 0.5; " + settings +
           " }\ndomain { grid: 45, 39; boundary: noflux }\n";
}

const std::vector<std::string>& all_settings() {
    static const std::vector<std::string> settings{"solver: euler; duration: 30.7; speed: 0.5",
                                                   "solver: symplectic; iterations: 60",
                                                   "solver: rk2; iterations: 60",
                                                   "solver: rk4; iterations: 60",
                                                   "solver: rk23; duration: 60",
                                                   "solver: rk45; duration: 60",
                                                   "solver: rkl1; speed: 7; iterations: 25",
                                                   "solver: rkl2; speed: auto; duration: 200",
                                                   "solver: ros2; speed: 0.5; iterations: 60",
                                                   "solver: ros2; speed: auto; duration: 60",
                                                   "speed: auto; duration: 150.3",
                                                   "iterations: 5000; until: steady(0.5)"};
    return settings;
}

/// The equation of Cahn and Hilliard with a stabilised solver: the number of steps, and the result.
TEST(Solvers, LegendreTakesNestedOperatorsInStages) {
    const auto run = [](const std::string& settings) {
        return run_text("stage s: cahn_hilliard { " + settings + " }\ndomain { grid: 48, 48 }",
                        {fastest_backend().name, 0, 1});
    };
    const Ran euler = run("speed: 0.025; iterations: 2000");
    for (const char* solver : {"rkl1", "rkl2"}) {
        const Ran legendre =
            run(fmt::format("solver: {}; speed: auto; tolerance: 0.01; duration: 50", solver));
        EXPECT_EQ(legendre.failure, "");
        EXPECT_LT(legendre.state().steps * (legendre.state().time.stages + 2), 1400) << solver;
        const Field& a = euler.state().species()[0];
        const Field& b = legendre.state().species()[0];
        EXPECT_NEAR(moments(b).mean, moments(a).mean, 1e-5) << solver;  // The total is conserved.
        const double difference =
            moments_of_difference(a, b).root_mean_square / moments(a).deviation;
        EXPECT_LT(difference, std::sqrt(2 * (1 - 0.95))) << solver;
    }
}

/// Diffusion with a direction on a surface takes at most a fifth of the evaluations of Euler's
/// method.
TEST(Solvers, LegendreTakesTensorsOnASurfaceInStages) {
    Overrides changes;
    changes.solver = "rkl1";
    const std::string text =
        "domain { grid: 48, 24; boundary: periodic, noflux; unit: 1/8\n"
        "surface: (1.2 + sy) * cos(2*pi*(sx + 0.2*sy)), (1.2 + sy) * sin(2*pi*(sx + 0.2*sy)), 3 * "
        "(1 - sy) }\n"
        "system one: witkin_kass { i: 1..1; theta[i]: pi/3; e: 2; rho: 0 }\n"
        "stage s: one { iterations: 4000; speed: 0.005; tolerance: 0.03 }\n";
    const Ran ran = run_text(text, {"interp", 0, 1}, changes);
    EXPECT_EQ(ran.failure, "");
    EXPECT_NEAR(ran.state().t, 20, 1e-5);
    EXPECT_LT(ran.state().steps * ran.state().time.stages, 800);
    EXPECT_GT(moments(ran.state().species()[0]).deviation, 0.1);
}

class SolversRun : public ResumedRunTest {};

TEST_F(SolversRun, ResumeWithTheSameBits) {
    for (const std::string& settings : all_settings()) {
        const std::string text = frozen_script(settings);
        run_whole(text);
        run_in_two_parts(text, "one", 7);
        for (const char* name : {"one.a.npy", "one.b.npy"}) {
            EXPECT_EQ(bytes(std::string("whole/") + name), bytes(std::string("rest/") + name))
                << settings;
        }
    }
}

TEST_F(SolversRun, StepsThatAreSplitOnAModelResumeWithTheSameBits) {
    // The weights of each cell sum to 4, so the fastest mode decays at the rate 8 * 0.4.
    for (const auto& [speed, parts] : {std::pair{1, 2}, {2, 4}, {4, 7}}) {
        const std::string text = fmt::format(
            "system heat {{ u: sx; u' = 0.4 * lap(u) }}\ndomain {{ surface: box; cells: 60; "
            "laplacian: turk }}\n"
            "stage one: heat {{ speed: {}; iterations: 9 }}",
            speed);
        run_whole(text);
        EXPECT_THAT(bytes("whole/run.json"), HasSubstr(fmt::format("\"stages\": {},", parts)));
        run_in_two_parts(text, "one", 4);
        EXPECT_EQ(bytes("whole/one.u.npy"), bytes("rest/one.u.npy")) << speed;
    }
}

TEST(Solvers, LegendreGrowsTheSameSpotsAsEuler) {
    const auto spots = [](const Overrides& overrides) {
        SimulationOptions options;
        options.threads = 1;
        return run_text(
            "stage s: turing_spots { iterations: 12000; ka: 1/200 }\ndomain { grid: 48, 48 }",
            options, overrides);
    };
    const Ran euler = spots({});
    for (const char* solver : {"rkl1", "rkl2"}) {
        Overrides changes;
        changes.solver = solver;
        const Ran legendre = spots(changes);
        EXPECT_DOUBLE_EQ(legendre.state().t, 12000);
        EXPECT_LT(legendre.state().steps, 1500);
        const Field& a = euler.state().species()[1];
        const Field& b = legendre.state().species()[1];
        const double difference =
            moments_of_difference(a, b).root_mean_square / moments(a).deviation;
        // The correlation of two fields with the same mean and deviation is 1 − difference² / 2.
        EXPECT_LT(difference, std::sqrt(2 * (1 - 0.99))) << solver;
    }
}

TEST(Solvers, TheOptionKeepsTheTimeOfEachStage) {
    Overrides changes;
    changes.solver = "rk23";
    const Ran ran = run_text(
        "system decay { u: 1; u' = -u }\nstage s: decay { speed: 0.25; iterations: 8 }\ndomain { "
        "grid: 4, 1 }",
        {"interp", 0, 1}, changes);
    EXPECT_DOUBLE_EQ(ran.state().t, 2);
    EXPECT_NEAR(ran.state().species()[0].at(0, 0), std::exp(-2.0), 1e-3);
}

TEST(Solvers, TheOptionSaysWhichStageCannotTakeIt) {
    Overrides changes;
    changes.solver = "rk4";
    const Script script =
        load_script("test",
                    "system decay { u: 1; u' = -u }\nstage s: decay { speed: 0.25 + 0.1 * x }", ".",
                    changes);
    EXPECT_FALSE(script.program);
    EXPECT_THAT(script.messages(false),
                HasSubstr("2:25: error: with rk4 all cells must have the same speed"));
}

}  // namespace
}  // namespace cascade
