// Integrators, compared with known solutions: their orders, their stability, and what they
// conserve.
#include "solvers/scheme.h"

#include "solvers/step_control.h"
#include "unit/solvers/scheme_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace cascade {
namespace {

using test::PlainRates;
using test::PlainState;
using test::SchemeRunner;
using test::swing;

double swing_error(Solver solver, int steps, std::uint32_t stages) {
    const double end = 2;
    SchemeRunner runner(make_scheme(solver, 2, false, stages), swing, {{0.0}, {1.0}});
    for (int n = 0; n < steps; ++n) runner.step(end / steps);
    return std::hypot(runner.state()[0][0] - std::sin(std::sin(end)),
                      runner.state()[1][0] - std::cos(std::sin(end)));
}

class Order : public ::testing::TestWithParam<Solver> {};

TEST_P(Order, IsWhatItsNameSays) {
    const Solver solver = GetParam();
    const double coarse = swing_error(solver, 64, 5), fine = swing_error(solver, 128, 5);
    const double order = std::log2(coarse / fine);
    RecordProperty("order", std::to_string(order));
    EXPECT_NEAR(order, order_of(solver), 0.12) << name_of(solver);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Order,
                         ::testing::Values(Solver::euler, Solver::symplectic, Solver::rk2,
                                           Solver::rk4, Solver::rk23, Solver::rk45, Solver::rkl1,
                                           Solver::rkl2, Solver::imex, Solver::etdrk4,
                                           Solver::gauss, Solver::ros2),
                         [](const auto& test) { return std::string(name_of(test.param)); });

/// The number of evaluations of the rates in a step. It is the number of stages for classical
/// methods, and one less for embedded ones, whose last rate is the first one of the next step.
TEST(Scheme, EvaluatesTheRatesAsOftenAsItMust) {
    const std::pair<Solver, std::size_t> all[] = {{Solver::euler, 1}, {Solver::rk2, 2},
                                                  {Solver::rk4, 4},   {Solver::rk23, 3},
                                                  {Solver::rk45, 6},  {Solver::rkl1, 5},
                                                  {Solver::rkl2, 5}};
    for (const auto& [solver, expected] : all) {
        const Scheme scheme = make_scheme(solver, 2, false, 5);
        EXPECT_EQ(scheme.evaluations(), expected) << name_of(solver);
        SchemeRunner runner(scheme, swing, {{0.0}, {1.0}});
        for (int n = 0; n < 10; ++n) runner.step(0.1);
        const std::size_t first = scheme.rate_registers ? 1 : 0;
        EXPECT_EQ(runner.evaluations(), static_cast<int>(10 * expected + first)) << name_of(solver);
    }
    EXPECT_EQ(make_scheme(Solver::symplectic, 3, true).evaluations(), 3u);
}

TEST(Scheme, RatesThatAreKeptAreThoseThatWouldBeEvaluated) {
    for (const Solver solver : {Solver::rk23, Solver::rk45}) {
        const Scheme scheme = make_scheme(solver, 2, false);
        SchemeRunner keeping(scheme, swing, {{0.0}, {1.0}});
        SchemeRunner forgetting(scheme, swing, {{0.0}, {1.0}});
        for (int n = 0; n < 20; ++n) {
            forgetting.forget_first_rate();
            for (SchemeRunner* runner : {&keeping, &forgetting}) {
                runner->attempt(0.25);  // A step that is rejected.
                runner->step(0.125);
            }
            EXPECT_EQ(keeping.state(), forgetting.state()) << name_of(solver) << n;
            EXPECT_EQ(keeping.error(), forgetting.error()) << name_of(solver) << n;
        }
        EXPECT_LT(keeping.evaluations(), forgetting.evaluations());
    }
}

/// A step keeps few stages, so that its planes fit into the cache: each sweep writes one plane of
/// each species. A plane that is overwritten is read only in the same cell, and the old step is
/// kept.
TEST(Scheme, StepsWithoutAnErrorKeepFewPlanes) {
    EXPECT_EQ(make_scheme(Solver::rk2, 1, false).registers, 3u);
    EXPECT_EQ(make_scheme(Solver::rk4, 1, false).registers, 4u);
    EXPECT_EQ(make_scheme(Solver::rkl1, 1, false, 9).registers, 3u);
    EXPECT_EQ(make_scheme(Solver::rkl1, 1, false, 1).registers, 2u);
    EXPECT_EQ(make_scheme(Solver::rkl2, 1, false, 9).registers, 4u);
    for (const Solver solver :
         {Solver::rk2, Solver::rk4, Solver::rk23, Solver::rk45, Solver::rkl1, Solver::rkl2}) {
        const Scheme scheme = make_scheme(solver, 1, false, 9);
        for (const Sweep& sweep : scheme.sweeps) {
            if (!scheme.error_register && solver != Solver::rkl2) {
                EXPECT_EQ(sweep.outputs.size(), 1u) << name_of(solver);
            }
            if (solver == Solver::rkl1) {
                EXPECT_LE(sweep.inputs.size(), 2u);
            }
            for (const RegisterId output : sweep.outputs) {
                EXPECT_NE(output, sweep.inputs[0]) << name_of(solver);
                EXPECT_NE(output, old_register) << name_of(solver);
                EXPECT_LT(output.index(), scheme.registers) << name_of(solver);
            }
        }
        EXPECT_EQ(scheme.sweeps.back().outputs[0], scheme.error_register.value_or(new_register));
    }
}

TEST(Scheme, NamesAreTheSettings) {
    EXPECT_EQ(solver_names().size(), 12u);
    for (const std::string& name : solver_names()) {
        ASSERT_TRUE(solver_of(name)) << name;
        EXPECT_EQ(name_of(*solver_of(name)), name);
    }
    EXPECT_FALSE(solver_of("leapfrog"));
}

/// The growth of u' = λ u over one step of length 1.
double growth(const Scheme& scheme, double lambda) {
    SchemeRunner runner(
        scheme, [=](const PlainState& state, double) { return PlainState{{lambda * state[0][0]}}; },
        {{1.0}});
    runner.step(1);
    return std::abs(runner.state()[0][0]);
}

TEST(Scheme, IsStableUpToItsInterval) {
    for (const Solver solver :
         {Solver::euler, Solver::rk2, Solver::rk4, Solver::rk23, Solver::rk45}) {
        const Scheme scheme = make_scheme(solver, 1, false);
        const double interval = stability_interval(solver);
        for (double part = 0.01; part < 0.999; part += 0.01) {
            EXPECT_LE(growth(scheme, -part * interval), 1 + 1e-9) << name_of(solver) << part;
        }
        EXPECT_GT(growth(scheme, -1.01 * interval), 1) << name_of(solver);
    }
}

TEST(Scheme, StagesMakeLegendreStable) {
    for (const Solver solver : {Solver::rkl1, Solver::rkl2}) {
        for (const std::uint32_t stages : {1u, 3u, 5u, 9u, 21u}) {
            if (stages < least_stages(solver)) continue;
            const Scheme scheme = make_scheme(solver, 1, false, stages);
            const double interval = stability_interval(solver, stages);
            for (int n = 1; n < 400; ++n) {
                EXPECT_LE(growth(scheme, -n / 400.0 * interval), 1 + 1e-9) << stages;
            }
            EXPECT_GT(growth(scheme, -1.3 * interval), 1) << name_of(solver) << stages;
        }
    }
}

TEST(Scheme, LegendreTakesAsFewStagesAsItCan) {
    for (const Solver solver : {Solver::rkl1, Solver::rkl2}) {
        for (const double ratio : {0.5, 3.0, 6.5, 21.0, 55.0, 500.0}) {
            const std::uint32_t stages = stages_for(solver, ratio);
            EXPECT_EQ(stages % 2, 1u);
            EXPECT_GE(stability_interval(solver, stages), 2 * ratio);
            if (stages > least_stages(solver)) {
                EXPECT_LT(stability_interval(solver, stages - 2), 2 * ratio);
            }
        }
        EXPECT_EQ(stages_for(solver, NAN), most_stages);
    }
}

TEST(Scheme, HeatDecaysAsTheoryHasItFarBeyondEulersLimit) {
    constexpr int cells = 32;
    const PlainRates heat = [](const PlainState& state, double) {
        const auto& u = state[0];
        PlainState rates(1, std::vector<double>(cells));
        for (int i = 0; i < cells; ++i) {
            rates[0][i] = u[(i + 1) % cells] + u[(i + cells - 1) % cells] - 2 * u[i];
        }
        return rates;
    };
    PlainState start(1);
    const double wave = 2 * std::numbers::pi / cells;
    for (int i = 0; i < cells; ++i) {
        // The last term is the mode that grows fastest in an unstable step.
        start[0].push_back(std::sin(wave * i) + 0.01 * (i % 2 == 0 ? 1 : -1));
    }
    const double lambda = 2 * std::cos(wave) - 2;
    for (const Solver solver : {Solver::rkl1, Solver::rkl2}) {
        const double step = 10;  // Euler's limit is 0.5.
        const std::uint32_t stages = stages_for(solver, step / 0.5);
        SchemeRunner runner(make_scheme(solver, 1, false, stages), heat, start);
        for (int n = 0; n < 5; ++n) runner.step(step);
        for (int i = 0; i < cells; ++i) {
            EXPECT_NEAR(runner.state()[0][i], std::exp(50 * lambda) * std::sin(wave * i),
                        solver == Solver::rkl1 ? 0.06 : 0.005);
        }
    }
}

TEST(Scheme, AStateWithoutRatesStaysToTheBit) {
    for (const Solver solver :
         {Solver::rk2, Solver::rk4, Solver::rk23, Solver::rk45, Solver::rkl1, Solver::rkl2}) {
        SchemeRunner runner(make_scheme(solver, 1, false, 7),
                            [](const PlainState&, double) { return PlainState{{0.0}}; }, {{0.1}});
        for (int n = 0; n < 100; ++n) runner.step(0.37);
        EXPECT_EQ(runner.state()[0][0], 0.1) << name_of(solver);
    }
}

/// The largest deviation of the energy u² + v² of an oscillator, over more than a thousand turns.
double energy_drift(Solver solver) {
    SchemeRunner runner(
        make_scheme(solver, 2, true),
        [](const PlainState& state, double) {
            return PlainState{{state[1][0]}, {-state[0][0]}};
        },
        {{1.0}, {0.0}}, 0.1);
    double worst = 0;
    for (int n = 0; n < 100000; ++n) {
        runner.step(0.1);
        const double u = runner.state()[0][0], v = runner.state()[1][0];
        worst = std::max(worst, std::abs(u * u + v * v - 1));
        if (worst > 10) break;
    }
    return worst;
}

TEST(Scheme, SymplecticBoundsTheEnergyWhereEulerDoesNot) {
    EXPECT_LT(energy_drift(Solver::symplectic), 0.06);
    EXPECT_GT(energy_drift(Solver::euler), 10);
}

/// The error at the end of an adaptive run of swing(), and the number of its steps.
std::pair<double, int> adaptive_run(Solver solver, double tolerance) {
    const double end = 10;
    SchemeRunner runner(make_scheme(solver, 2, false), swing, {{0.0}, {1.0}});
    StepControl control(1.0, order_of(solver));
    int steps = 0;
    while (runner.time() < end && steps < 100000) {
        const double step = std::min(control.step(), end - runner.time());
        runner.attempt(step);
        const double error = std::hypot(runner.error()[0][0], runner.error()[1][0]) / tolerance;
        if (control.judge(step, error)) runner.accept();
        ++steps;
    }
    return {std::hypot(runner.state()[0][0] - std::sin(std::sin(end)),
                       runner.state()[1][0] - std::cos(std::sin(end))),
            steps};
}

TEST(StepControl, KeepsTheTolerance) {
    for (const Solver solver : {Solver::rk23, Solver::rk45}) {
        const auto [rough, few] = adaptive_run(solver, 1e-3);
        const auto [fine, many] = adaptive_run(solver, 1e-6);
        EXPECT_LT(rough, 1e-2) << name_of(solver);
        EXPECT_LT(fine, 2e-5) << name_of(solver);
        EXPECT_LT(few, many);
        EXPECT_LT(many, solver == Solver::rk23 ? 1500 : 150);
    }
}

TEST(StepControl, AValueThatIsNotFiniteShortensTheStep) {
    StepControl control(1.0, 3);
    EXPECT_FALSE(control.judge(1.0, NAN));
    EXPECT_DOUBLE_EQ(control.step(), 0.1);
    EXPECT_FALSE(control.judge(0.1, INFINITY));
    EXPECT_DOUBLE_EQ(control.step(), 0.01);
    // After a rejection the step does not grow at once.
    EXPECT_TRUE(control.judge(0.01, 1e-6));
    EXPECT_DOUBLE_EQ(control.step(), 0.01);
    EXPECT_TRUE(control.judge(0.01, 1e-6));
    EXPECT_NEAR(control.step(), 0.01 * 0.9 * std::pow(1e6, 0.1), 1e-6);
}

TEST(StepControl, GoesOnFromItsState) {
    StepControl one(0.3, 5);
    one.judge(0.3, 0.2);
    StepControl other(one.state(), 5);
    one.judge(one.step(), 0.7);
    other.judge(other.step(), 0.7);
    EXPECT_EQ(one.step(), other.step());
}

}  // namespace
}  // namespace cascade
