// The motion of a tissue, compared with theory.
#include "tissue/tissue_loop.h"

#include "tests/unit/tissue/function_rules.h"

#include <cmath>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

FunctionRules pushing_rules() {
    FunctionRules rules;
    rules.rate = [](const CellState& cell, double* rates) { push(cell, 0.5, rates); };
    return rules;
}

TissueSchedule until(double t) {
    TissueSchedule schedule;
    schedule.end_time = t;
    return schedule;
}

TEST(TissueLoop, TwoCellsComeToRestAtTheSumOfTheirRadii) {
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        FunctionRules rules = pushing_rules();
        Growth run(rules, cells_at({{1, 1, 1}, {1.03, 1, 1}}, 0.02, 4), until(60), precision);
        const TissueOutcome outcome = run.go();
        EXPECT_TRUE(outcome.ended);
        EXPECT_EQ(outcome.t, 60);
        EXPECT_FALSE(outcome.failure);
        EXPECT_NEAR(length(run.place(1) - run.place(0)), 0.04, 1e-6);
        EXPECT_NEAR(run.place(0).x + run.place(1).x, 2.03, 1e-6);
    }
}

/// d' = −2 k (2 r − d) while the cells overlap.
TEST(TissueLoop, OverlapDecaysExponentially) {
    FunctionRules rules = pushing_rules();
    TissueSchedule schedule = until(1.5);
    schedule.tolerance = 1e-7;
    Growth run(rules, cells_at({{1, 1, 1}, {1.03, 1, 1}}, 0.02, 4), schedule);
    run.go();
    const double distance = length(run.place(1) - run.place(0));
    EXPECT_NEAR(0.04 - distance, 0.01 * std::exp(-1.5), 1e-7);
}

std::vector<Vector3d> hexagons(int n, double spacing) {
    std::vector<Vector3d> places;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            places.push_back(
                {0.2 + spacing * (i + 0.5 * (j % 2)), 0.2 + spacing * std::sqrt(0.75) * j, 0.5});
        }
    }
    return places;
}

TEST(TissueLoop, AHexagonalPackingStaysAtRest) {
    FunctionRules rules = pushing_rules();
    const TissueRecord start = cells_at(hexagons(12, 0.04), 0.02, 4);
    Growth run(rules, start, until(10));
    run.go();
    const TissueRecord end = run.tissue().record();
    for (std::size_t k = 0; k < start.numbers.size(); ++k) {
        for (std::size_t s = 0; s < 3; ++s) {
            EXPECT_NEAR(end.species[s][k], start.species[s][k], 1e-12);
        }
    }
}

/// The sum of the squares of the overlaps.
double energy(const Tissue& tissue) {
    double sum = 0;
    for (std::size_t a = 0; a < tissue.count(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            const double distance = length(place_of(tissue, {}, a) - place_of(tissue, {}, b));
            const double overlap =
                std::max(0.0, tissue.value(3, a) + tissue.value(3, b) - distance);
            sum += overlap * overlap;
        }
    }
    return sum;
}

TEST(TissueLoop, TheEnergyOfCollisionsNeverRises) {
    FunctionRules rules = pushing_rules();
    std::vector<Vector3d> places = hexagons(9, 0.03);
    for (std::size_t k = 0; k < places.size(); ++k) {
        places[k].x += 0.006 * std::sin(12.9898 * static_cast<double>(k));
        places[k].y += 0.006 * std::sin(78.233 * static_cast<double>(k));
    }
    Growth run(rules, cells_at(places, 0.02, 4), until(40));
    double before = energy(run.tissue());
    const double first = before;
    const TissueOutcome outcome = run.go(1000, [&](const Tissue& tissue) {
        const double now = energy(tissue);
        EXPECT_LE(now, before * (1 + 1e-12));
        before = now;
        return true;
    });
    EXPECT_TRUE(outcome.ended);
    EXPECT_GT(outcome.list_builds, 1);
    EXPECT_LT(before, 0.01 * first);
}

/// A force between all cells that is a smooth function of the distance.
void attract(const CellState& cell, double* rates) {
    cell.each_neighbour([&](std::int64_t, Vector3d direction, double distance) {
        const double force = distance * std::exp(-distance * distance) * (1 + 0.5 * cell.t);
        rates[0] += force * direction.x;
        rates[1] += force * direction.y;
        rates[2] += force * direction.z;
    });
}

double attracted(Solver solver, double step) {
    FunctionRules rules;
    rules.rate = attract;
    rules.solver = solver;
    rules.is_judged = false;
    TissueSchedule schedule = until(1);
    schedule.step = step;
    schedule.neighbours.near = 10;
    Growth run(rules, cells_at({{0.1, 0.2, 0.3}, {0.9, 0.3, 0.4}, {0.3, 1.2, 0.5}}, 0.02, 4),
               schedule);
    EXPECT_TRUE(run.go().ended);
    return run.place(0).x;
}

TEST(TissueLoop, IntegratorsHaveTheirOrders) {
    const double exact = attracted(Solver::rk4, 1.0 / 512);
    const auto order = [&](Solver solver) {
        const double coarse = std::abs(attracted(solver, 1.0 / 8) - exact);
        const double fine = std::abs(attracted(solver, 1.0 / 16) - exact);
        return std::log2(coarse / fine);
    };
    EXPECT_NEAR(order(Solver::euler), 1, 0.2);
    EXPECT_NEAR(order(Solver::rk2), 2, 0.3);
    EXPECT_NEAR(order(Solver::rk4), 4, 0.5);
    EXPECT_NEAR(order(Solver::rkl2), 2, 0.3);
}

TEST(TissueLoop, StepsFollowTheTolerance) {
    const double exact = attracted(Solver::rk4, 1.0 / 512);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        for (const Solver solver : {Solver::rkl2, Solver::rk45}) {
            FunctionRules rules;
            rules.rate = attract;
            rules.solver = solver;
            TissueSchedule schedule = until(1);
            schedule.tolerance = tolerance;
            schedule.neighbours.near = 10;
            Growth run(rules,
                       cells_at({{0.1, 0.2, 0.3}, {0.9, 0.3, 0.4}, {0.3, 1.2, 0.5}}, 0.02, 4),
                       schedule);
            EXPECT_TRUE(run.go().ended);
            EXPECT_LT(std::abs(run.place(0).x - exact), 0.2 * tolerance);
        }
    }
}

/// With k = 500, explicit steps would have to be shorter than 0.002.
TEST(TissueLoop, StiffForcesTakeStagesInsteadOfSteps) {
    FunctionRules rules;
    rules.rate = [](const CellState& cell, double* rates) {
        push(cell, 500, rates);
        rates[0] += 0.01;
    };
    Growth run(rules, cells_at({{1, 1, 1}, {1.0399, 1, 1}, {1.07989, 1, 1}}, 0.02, 4), until(20));
    // The largest eigenvalue of three cells in a row is 3 k. The estimate adds a tenth.
    run.go(1);
    EXPECT_NEAR(run.tissue().time.stiffness, 1650, 50);
    const TissueOutcome outcome = run.go();
    EXPECT_TRUE(outcome.ended);
    EXPECT_LT(outcome.steps, 300);
    EXPECT_NEAR(length(run.place(1) - run.place(0)), 0.04, 1e-6);
}

TEST(TissueLoop, CellsStayOnThePlane) {
    FunctionRules rules;
    rules.rate = [](const CellState&, double* rates) {
        rates[0] = 0.3;
        rates[1] = -0.2;
    };
    rules.surroundings = in_box({1, 0.5, 0}, {true, false, false});
    Growth run(rules, cells_at({{0.9, 0.1, 0}, {0.2, 0.3, 0}}, 0.1, 4), until(10));
    run.go();
    EXPECT_NEAR(run.place(0).x, 0.9, 1e-9);
    EXPECT_EQ(run.place(0).y, 0);
    EXPECT_EQ(run.place(1).y, 0);
    EXPECT_NEAR(run.place(1).x, 0.2, 1e-9);
}

TEST(TissueLoop, CellsCollideThroughAPeriodicSide) {
    FunctionRules rules = pushing_rules();
    rules.surroundings = in_box({1, 1, 0}, {true, true, false});
    Growth run(rules, cells_at({{0.01, 0.5, 0}, {0.99, 0.5, 0}}, 0.02, 4), until(40));
    run.go();
    EXPECT_NEAR(run.place(1).x - run.place(0).x, 0.96, 1e-6);
}

TEST(TissueLoop, EndsAtRest) {
    FunctionRules rules = pushing_rules();
    TissueSchedule schedule = until(1e6);
    schedule.steady = 1e-3;
    Growth run(rules, cells_at({{1, 1, 1}, {1.03, 1, 1}}, 0.02, 4), schedule);
    const TissueOutcome outcome = run.go();
    EXPECT_TRUE(outcome.is_steady);
    EXPECT_GT(outcome.t, 5);
    EXPECT_LT(outcome.t, 100);
    EXPECT_NEAR(length(run.place(1) - run.place(0)), 0.04, 4e-5);
}

TEST(TissueLoop, NeverRestsWhileSomethingGrows) {
    FunctionRules rules = pushing_rules();
    rules.species = 5;
    rules.rate = [](const CellState&, double* rates) { rates[4] = 1e-3; };
    TissueSchedule schedule = until(2000);
    schedule.steady = 1e-3;
    Growth run(rules, cells_at({{1, 1, 1}}, 0.02, 5), schedule);
    EXPECT_FALSE(run.go().is_steady);
}

TEST(TissueLoop, NamesTheCellWhoseRateIsNotFinite) {
    FunctionRules rules;
    rules.species = 5;
    rules.rate = [](const CellState& cell, double* rates) {
        rates[4] = cell.own(0) > 1.5 && cell.t > 0.5 ? NAN : 1;
    };
    Growth run(rules, cells_at({{1, 1, 1}, {1.6, 1, 1}}, 0.02, 5), until(2));
    const TissueOutcome outcome = run.go();
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->kind, TissueFailure::Kind::rate_not_finite);
    EXPECT_EQ(outcome.failure->number, 1U);
    EXPECT_EQ(outcome.failure->species, 4U);
    EXPECT_NEAR(outcome.failure->t, 0.5, 1e-3);
    EXPECT_TRUE(std::isfinite(run.tissue().value(4, 1)));
}

TEST(TissueLoop, NamesTheCellWhoseErrorStaysLarge) {
    FunctionRules rules;
    rules.species = 5;
    rules.rate = [](const CellState& cell, double* rates) {
        rates[4] = cell.own(0) > 1.5 ? 1 / (1 - cell.t) / (1 - cell.t) : 1;
    };
    Growth run(rules, cells_at({{1, 1, 1}, {1.6, 1, 1}}, 0.02, 5), until(2));
    const TissueOutcome outcome = run.go();
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->number, 1U);
    EXPECT_EQ(outcome.failure->species, 4U);
    EXPECT_NEAR(outcome.failure->t, 1, 1e-3);
}

TEST(TissueLoop, RefusesFixedStepsThatLeadTooFar) {
    FunctionRules rules;
    rules.rate = [](const CellState&, double* rates) { rates[0] = 1; };
    rules.solver = Solver::euler;
    rules.is_judged = false;
    TissueSchedule schedule = until(1);
    schedule.step = 0.1;
    Growth run(rules, cells_at({{1, 1, 1}}, 0.02, 4), schedule);
    const TissueOutcome outcome = run.go();
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->kind, TissueFailure::Kind::too_far);
    EXPECT_EQ(run.place(0).x, 1);
}

TEST(TissueLoop, IsCancelledBetweenSteps) {
    FunctionRules rules = pushing_rules();
    Growth run(rules, cells_at({{1, 1, 1}, {1.03, 1, 1}}, 0.02, 4), until(60));
    EXPECT_EQ(run.go(3).steps, 3);
    const TissueOutcome cancelled = run.go(10, [&](const Tissue& tissue) {
        if (tissue.time.steps == 5) run.control.cancel = true;
        return true;
    });
    EXPECT_TRUE(cancelled.cancelled);
    EXPECT_EQ(cancelled.steps, 5);
}

/// Runs cells that wake up suddenly, so that several attempts at a step fail. If `number` is above
/// 0, evaluation `number` of a rate cancels the run, which then goes on. Returns the record of the
/// run.
TissueRecord cancelled_at(std::int64_t number, std::int64_t& evaluations, std::int64_t& left_at) {
    FunctionRules rules;
    evaluations = 0;
    RunControl* control = nullptr;
    rules.solver = Solver::rk45;
    rules.rate = [&](const CellState& cell, double* rates) {
        push(cell, 0.5, rates);
        if (cell.t > 1) rates[0] += 0.02 * std::sin(2000 * (cell.t - 1));
        if (++evaluations == number) control->cancel = true;
    };
    Growth run(rules, cells_at({{1, 1, 1}, {1.03, 1, 1}}, 0.02, 4), until(1.1));
    control = &run.control;
    const TissueOutcome outcome = run.go();
    EXPECT_EQ(outcome.cancelled, number > 0);
    left_at = outcome.steps;
    run.control.cancel = false;
    if (outcome.cancelled) {
        EXPECT_TRUE(run.go().ended);
    }
    return run.tissue().record();
}

TEST(TissueLoop, IsCancelledWithinAStepAndGoesOnWithTheSameBits) {
    std::int64_t all = 0, evaluations = 0, steps = 0, left_at = 0;
    const TissueRecord whole = cancelled_at(0, all, steps);
    ASSERT_GT(all, 400);

    for (std::int64_t number = 10; number < all - 40; number += all / 40) {
        expect_equal_records(cancelled_at(number, evaluations, left_at), whole);
        EXPECT_LT(left_at, steps);
    }
}

}  // namespace
}  // namespace cascade::test
