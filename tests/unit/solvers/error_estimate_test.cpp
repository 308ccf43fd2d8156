// The estimate of a step's error, compared with theory.
#include "solvers/error_estimate.h"

#include "unit/solvers/scheme_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace cascade {
namespace {

using test::PlainState;
using test::SchemeRunner;
using test::swing;

constexpr Solver unjudged[] = {Solver::euler, Solver::symplectic, Solver::rk2,  Solver::rk4,
                               Solver::rkl1,  Solver::rkl2,       Solver::imex, Solver::etdrk4,
                               Solver::gauss, Solver::ros2};

double largest_error(Solver solver, double step) {
    SchemeRunner runner(with_error_estimate(make_scheme(solver, 2, false, 5)), swing,
                        {{0.6}, {0.8}});
    runner.attempt(step);
    double largest = 0;
    for (const auto& of_species : runner.error())
        largest = std::max(largest, std::abs(of_species[0]));
    return largest;
}

TEST(ErrorEstimate, IsTheLeadingTermOfEulersError) {
    SchemeRunner runner(
        with_error_estimate(make_scheme(Solver::euler, 1, false)),
        [](const PlainState& state, double) { return PlainState{{-3 * state[0][0]}}; }, {{2.0}});
    runner.attempt(0.1);
    EXPECT_NEAR(runner.error()[0][0], 0.5 * 0.3 * 0.3 * 2, 1e-15);
    EXPECT_NEAR(runner.state()[0][0], 2, 0) << "an attempt is no step";
}

TEST(ErrorEstimate, FallsWithThePowerOfTheStepThatItIsSaidTo) {
    for (const Solver solver : unjudged) {
        const double order =
            std::log2(largest_error(solver, 1.0 / 64) / largest_error(solver, 1.0 / 128));
        EXPECT_NEAR(order, order_of_estimate(solver), 0.12) << name_of(solver);
    }
}

TEST(ErrorEstimate, CostsNoEvaluationOfTheRates) {
    for (const Solver solver : unjudged) {
        const Scheme plain = make_scheme(solver, 2, false, 5);
        const Scheme judged = with_error_estimate(plain);
        const bool has_own = solver == Solver::etdrk4 || solver == Solver::ros2;
        EXPECT_EQ(judged.evaluations(), plain.evaluations()) << name_of(solver);
        EXPECT_EQ(judged.registers, plain.registers + (has_own ? 1 : 3)) << name_of(solver);
    }
}

TEST(ErrorEstimate, LeavesTheStepAsItIs) {
    for (const Solver solver : unjudged) {
        const Scheme plain = make_scheme(solver, 2, false, 5);
        SchemeRunner with(with_error_estimate(plain), swing, {{0.6}, {0.8}});
        SchemeRunner without(plain, swing, {{0.6}, {0.8}});
        for (int n = 0; n < 5; ++n) {
            with.step(0.1);
            without.step(0.1);
            EXPECT_EQ(with.state(), without.state()) << name_of(solver);
        }
    }
}

}  // namespace
}  // namespace cascade
