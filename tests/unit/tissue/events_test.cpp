// Divisions and deaths: their moments, compared with theory, and that the moments do not depend on
// how they are computed.
#include "mesh/shapes.h"
#include "tests/unit/tissue/function_rules.h"
#include "tissue/random_direction.h"
#include "tissue/tissue_loop.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

/// Species 4, called ripe, grows at this rate. Cells divide when it reaches 1, and it starts again
/// at 0.
FunctionRules ripening(CellRates rate) {
    FunctionRules rules;
    rules.species = 5;
    rules.rate = std::move(rate);
    rules.condition_planes = 1;
    rules.condition = [](const CellState& cell, double* results) {
        results[0] = cell.own(4) > 1 ? 1 : 0;
    };
    rules.restarted_from = 4;
    rules.restart = [](const CellState&, double* results) { results[0] = 0; };
    return rules;
}

/// The moments of all divisions.
std::vector<double> division_times(FunctionRules& rules, const TissueRecord& start,
                                   const TissueSchedule& schedule) {
    Growth run(rules, start, schedule);
    std::vector<double> times;
    std::int64_t births = 0;
    const TissueOutcome outcome = run.go(100000, [&](const Tissue& tissue) {
        if (tissue.births > births) times.push_back(tissue.time.t);
        births = tissue.births;
        return true;
    });
    EXPECT_TRUE(outcome.ended);
    return times;
}

TEST(Events, HappenAtTheirMoments) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1.0 / 3; });
    rules.solver = Solver::rk4;
    rules.is_judged = false;
    TissueSchedule schedule;
    schedule.step = 0.4;
    schedule.end_time = 7;
    const std::vector<double> times =
        division_times(rules, cells_at({{1, 1, 1}}, 0.02, 5), schedule);
    ASSERT_EQ(times.size(), 2U);
    EXPECT_NEAR(times[0], 3, 1e-6 * 0.4);
    EXPECT_NEAR(times[1], 6, 2e-6 * 0.4);
}

/// ripe' = 2 − ripe reaches 1 at ln 2.
TEST(Events, HappenAtTheirMomentsOnCurves) {
    FunctionRules rules =
        ripening([](const CellState& cell, double* rates) { rates[4] = 2 - cell.own(4); });
    rules.solver = Solver::rk4;
    rules.is_judged = false;
    TissueSchedule schedule;
    schedule.step = 0.013;
    schedule.end_time = 1;
    const std::vector<double> times =
        division_times(rules, cells_at({{1, 1, 1}}, 0.02, 5), schedule);
    ASSERT_EQ(times.size(), 1U);
    EXPECT_NEAR(times[0], std::log(2), 1e-6 * 0.013);
}

/// The moments are ln 2 and 2 ln 2. Bisection would evaluate the condition more than 20 times.
TEST(Events, TakeFewEvaluationsOfConditionsThatGoSmoothlyThroughZero) {
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        FunctionRules rules =
            ripening([](const CellState& cell, double* rates) { rates[4] = 2 - cell.own(4); });
        int evaluations = 0, before = 0, most = 0, least = 100;
        rules.condition = [&](const CellState& cell, double* results) {
            if (cell.element == 0) ++evaluations;
            results[0] = cell.own(4) - 1;
        };
        rules.solver = Solver::rk4;
        rules.is_judged = false;
        TissueSchedule schedule;
        schedule.step = 0.2;
        schedule.end_time = 2;
        Growth run(rules, cells_at({{1, 1, 1}}, 0.02, 5), schedule, precision);
        std::vector<double> times;
        run.go(100, [&](const Tissue& tissue) {
            most = std::max(most, evaluations - before);
            least = std::min(least, evaluations - before);
            before = evaluations;
            if (tissue.time.last_event == tissue.time.t) times.push_back(tissue.time.t);
            return true;
        });
        EXPECT_LE(most, 11);
        EXPECT_EQ(least, 1);
        ASSERT_EQ(times.size(), 2U);
        EXPECT_NEAR(times[0], std::log(2), 1e-4);
        EXPECT_NEAR(times[1], 2 * std::log(2), 2e-4);
    }
}

/// Cells far from each other, the first two of which divide between 0.4 and 0.8.
TissueRecord mostly_unripe() {
    std::vector<Vector3d> places;
    for (int k = 0; k < 60; ++k) places.push_back({0.1 + 0.03 * k, 1, 1});
    TissueRecord record = cells_at(places, 0.01, 6);
    std::fill(record.species[4].begin(), record.species[4].end(), -1.0);
    record.species[4][0] = 0.5;
    record.species[4][1] = 0.4;
    return record;
}

/// Rules with ripe' = 2 − ripe. Species 5 is the time.
FunctionRules ripening_on_curves() {
    FunctionRules rules = ripening([](const CellState& cell, double* rates) {
        rates[4] = 2 - cell.own(4);
        rates[5] = 1;
    });
    rules.species = 6;
    rules.condition = [](const CellState& cell, double* results) { results[0] = cell.own(4) - 1; };
    rules.restart = [](const CellState& cell, double* results) {
        results[0] = 0;
        results[1] = cell.own(5) / 2;
    };
    rules.solver = Solver::rk4;
    rules.is_judged = false;
    return rules;
}

/// Cells divide at moments within a step. Species that start again then are integrated to the end
/// of the step.
TEST(Events, OfAStepHappenAtTheirMoments) {
    double error_before = 0;
    for (const double step : {0.4, 0.2, 0.1}) {
        FunctionRules rules = ripening_on_curves();
        TissueSchedule schedule;
        schedule.step = step;
        schedule.end_time = 0.8;
        Growth run(rules, mostly_unripe(), schedule);
        const TissueOutcome outcome = run.go();
        EXPECT_EQ(outcome.steps, std::lround(0.8 / step));
        const TissueRecord record = run.tissue().record();
        ASSERT_EQ(record.numbers.size(), 62U);
        double error = 0;
        for (const std::size_t cell : {0, 1}) {
            const std::size_t child = 60 + cell;
            const double moment = std::log(cell == 0 ? 1.5 : 1.6), left = 0.8 - moment;
            EXPECT_EQ(record.species[4][child], record.species[4][cell]);
            error = std::max(error, std::abs(record.species[4][cell] - 2 * (1 - std::exp(-left))));
            EXPECT_NEAR(record.species[5][cell], moment / 2 + left, 1e-3 * step);
            EXPECT_NEAR(record.species[5][child], moment / 2 + left, 1e-3 * step);
        }
        EXPECT_LT(error, 0.35 * std::pow(step, 3));  // The error of Heun's method is left³ / 3.
        if (error_before > 0) {
            EXPECT_LT(error, error_before / 3);
        }
        error_before = error;
    }
}

/// If conditions read other cells, or events must be exact, steps end at each event.
TEST(Events, EndStepsWhereTheyMust) {
    for (const bool is_exact : {false, true}) {
        FunctionRules rules = ripening_on_curves();
        rules.is_of_cell_alone = is_exact;
        TissueSchedule schedule;
        schedule.step = 0.4;
        schedule.end_time = 0.8;
        schedule.has_exact_events = is_exact;
        const std::vector<double> times = division_times(rules, mostly_unripe(), schedule);
        ASSERT_EQ(times.size(), 2U);
        EXPECT_NEAR(times[0], std::log(1.5), 1e-3);
        EXPECT_NEAR(times[1], std::log(1.6), 1e-3);
    }
}

/// If many cells would divide in one step, it ends after a twentieth of the cells have divided.
TEST(Events, OfManyCellsTakeSeveralSteps) {
    TissueRecord start = mostly_unripe();
    for (std::size_t cell = 0; cell < 60; ++cell) {
        start.species[4][cell] = 0.8 - 0.01 * static_cast<double>(cell);
    }
    FunctionRules rules = ripening_on_curves();
    TissueSchedule schedule;
    schedule.step = 1;
    schedule.end_time = 0.8;
    Growth run(rules, start, schedule);
    const TissueOutcome outcome = run.go();
    EXPECT_GT(outcome.steps, 10);
    EXPECT_LT(outcome.steps, 30);
    EXPECT_EQ(run.tissue().births, 60);
}

TEST(Events, GiveBothCellsTheSameValuesOnBothSidesOfTheMother) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    TissueSchedule schedule;
    schedule.end_time = 1.5;
    Growth run(rules, cells_at({{1, 1.25, 1}}, 0.02, 5), schedule);
    run.go();
    const TissueRecord record = run.tissue().record();
    EXPECT_EQ(record.numbers, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_NEAR(record.species[4][0], 0.5, 1e-6);
    EXPECT_EQ(record.species[4][0], record.species[4][1]);
    EXPECT_NEAR(length(run.place(1) - run.place(0)), 0.02, 1e-12);
    EXPECT_NEAR(run.place(0).y + run.place(1).y, 2.5, 1e-12);
    EXPECT_EQ(record.births, 1);
    EXPECT_NEAR(record.time.last_event, 1, 1e-6);
}

TEST(Events, FollowTheDirectionThatRulesGive) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    rules.direction = [](const CellState&, double* results) {
        results[0] = results[2] = 0;
        results[1] = 7;
    };
    TissueSchedule schedule;
    schedule.end_time = 1.5;
    Growth run(rules, cells_at({{1, 1.25, 1}}, 0.02, 5), schedule);
    run.go();
    EXPECT_NEAR(run.place(1).y - run.place(0).y, 0.02, 1e-12);
    EXPECT_EQ(run.place(1).x, run.place(0).x);
}

TEST(Events, DivideInTheTangentPlane) {
    const SurfaceMesh mesh = *sphere_mesh(0.5, 0.02);
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    rules.surroundings = around_surface(mesh);
    TissueSchedule schedule;
    schedule.end_time = 1.5;
    Growth run(rules, cells_at({{0.5, 0, 0}}, 0.02, 5), schedule);
    run.go();
    EXPECT_NEAR(run.place(1).x, run.place(0).x, 1e-3);
}

TEST(Events, LetCellsDie) {
    FunctionRules rules;
    rules.rate = [](const CellState&, double* rates) { rates[0] = 0.1; };
    rules.condition_planes = 2;
    rules.condition = [](const CellState& cell, double* results) {
        results[0] = 0;
        results[1] = cell.own(0) > 1 ? 1 : 0;
    };
    TissueSchedule schedule;
    schedule.end_time = 10;
    Growth run(rules, cells_at({{0.2, 1, 1}, {0.1, 1, 1}, {0.95, 1, 1}, {1.5, 1, 1}}, 0.2, 4),
               schedule);
    std::vector<std::size_t> counts;
    const TissueOutcome outcome = run.go(1000, [&](const Tissue& tissue) {
        if (counts.empty() || counts.back() != tissue.count()) counts.push_back(tissue.count());
        return true;
    });
    // One cell is dead at the start, and the death of the last cell ends the stage.
    EXPECT_EQ(counts, (std::vector<std::size_t>{3, 2, 1, 0}));
    EXPECT_TRUE(outcome.ended);
    EXPECT_NEAR(outcome.t, 9, 1e-5);
    EXPECT_EQ(run.tissue().deaths, 4);
}

TEST(Events, ThatMakeNothingSmallerAreRefused) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    rules.restart = {};
    TissueSchedule schedule;
    schedule.end_time = 2;
    Growth run(rules, cells_at({{1, 1, 1}, {1.2, 1, 1}}, 0.02, 5), schedule);
    const TissueOutcome outcome = run.go();
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->kind, TissueFailure::Kind::divides_for_ever);
    EXPECT_EQ(outcome.failure->number, 0U);
    EXPECT_NEAR(outcome.failure->t, 1, 1e-6);
}

/// Large founders may divide several times at the same moment.
TEST(Events, MayFollowEachOtherAtOneMoment) {
    FunctionRules rules;
    rules.condition_planes = 1;
    rules.condition = [](const CellState& cell, double* results) {
        results[0] = cell.own(3) > 0.02 ? 1 : 0;
    };
    rules.restarted_from = 3;
    rules.restart = [](const CellState& cell, double* results) { results[0] = cell.own(3) / 2; };
    TissueSchedule schedule;
    schedule.end_time = 1;
    Growth run(rules, cells_at({{1, 1, 1}}, 0.1, 4), schedule);
    EXPECT_TRUE(run.go().ended);
    EXPECT_EQ(run.tissue().count(), 8U);
    EXPECT_EQ(run.tissue().value(3, 7), 0.0125);
}

TEST(Events, StopAtTheLargestNumberOfCells) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    TissueSchedule schedule;
    schedule.end_time = 100;
    schedule.most_cells = 100;
    Growth run(rules, cells_at({{1, 1, 1}}, 0.02, 5), schedule);
    const TissueOutcome outcome = run.go();
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->kind, TissueFailure::Kind::too_many_cells);
    EXPECT_EQ(outcome.failure->cells, 128U);
    EXPECT_EQ(run.tissue().count(), 64U);
}

/// The first cell divides again and again without end, and its daughters die.
TEST(Events, ThatGoOnForEverAreRemarked) {
    FunctionRules rules = ripening([](const CellState&, double* rates) { rates[4] = 1; });
    rules.condition_planes = 2;
    rules.condition = [](const CellState& cell, double* results) {
        results[0] = cell.own(4) > 1 ? 1 : 0;
        results[1] = cell.own(0) > 0.6 && cell.own(4) > 0.5 ? 1 : 0;
    };
    rules.direction = [](const CellState&, double* results) {
        results[0] = 1;
        results[1] = results[2] = 0;
    };
    rules.rate = [](const CellState& cell, double* rates) {
        rates[0] = cell.own(0) > 0.6 ? 0 : 5 * (0.5 - cell.own(0));
        rates[4] = 1;
    };
    TissueSchedule schedule;
    schedule.end_time = 10;
    schedule.most_cells = 100;
    Growth run(rules, cells_at({{0.5, 1, 1}}, 0.25, 5), schedule);
    const TissueOutcome outcome = run.go();
    EXPECT_FALSE(outcome.failure);
    EXPECT_LE(run.tissue().count(), 2U);
    ASSERT_TRUE(outcome.turnover);
    EXPECT_GE(outcome.turnover->births, 4 * outcome.turnover->cells);
    EXPECT_GE(outcome.turnover->deaths, 4 * outcome.turnover->cells);
    EXPECT_GT(outcome.turnover->to, outcome.turnover->from);
}

/// A torus that is being covered by cells. They push each other, stick to the surface, and divide
/// where there is room.
class Cover {
public:
    Cover() : mesh_(*torus_mesh(0.35, 0.15, 0.04)) {
        rules_.surroundings = around_surface(mesh_);
        rules_.senses = true;
        rules_.species = 5;
        rules_.rate = [](const CellState& cell, double* rates) {
            push(cell, 2, rates);
            double crowd = 0;
            cell.each_neighbour([&](std::int64_t other, Vector3d, double distance) {
                const double touching = cell.radius(cell.element) + cell.radius(other);
                crowd += std::clamp((1.2 - distance / touching) / 0.2, 0.0, 1.0);
            });
            rates[0] -= cell.off * cell.normal.x;
            rates[1] -= cell.off * cell.normal.y;
            rates[2] -= cell.off * cell.normal.z;
            rates[4] = 2 * (1 + std::tanh(2.6 - crowd)) - cell.own(4);
        };
        rules_.condition_planes = 2;
        rules_.condition = [](const CellState& cell, double* results) {
            results[0] = cell.own(4) > 1 ? 1 : 0;
            results[1] = std::abs(cell.off) > 0.5 * cell.own(3) ? 1 : 0;
        };
        rules_.restarted_from = 4;
        rules_.restart = [](const CellState&, double* results) { results[0] = 0; };
        schedule_.end_time = 3;
        schedule_.tolerance = 1e-2;
        schedule_.seed = 7;
    }

    TissueRecord founders() const {
        return cells_at({{0.5, 0, 0}, {0, 0, 0.5}, {-0.5, 0, 0}, {0, 0.15, -0.35}}, 0.03, 5);
    }
    /// The run is stopped and resumed after every `steps_at_once` steps.
    TissueRecord grown(Precision precision, std::int64_t steps_at_once = 1'000'000) {
        TissueRecord record = founders();
        for (;;) {
            Growth run(rules_, record, schedule_, precision);
            const TissueOutcome outcome = run.go(record.time.steps + steps_at_once);
            EXPECT_FALSE(outcome.failure);
            record = run.tissue().record();
            if (outcome.ended || outcome.failure) return record;
        }
    }
    TissueSchedule& schedule() { return schedule_; }

private:
    SurfaceMesh mesh_;
    FunctionRules rules_;
    TissueSchedule schedule_;
};

TEST(Events, OnATorusCoverIt) {
    Cover cover;
    const TissueRecord record = cover.grown(Precision::single);
    EXPECT_GT(record.numbers.size(), 30U);
    EXPECT_GT(record.births, 30);
    EXPECT_EQ(record.numbers.size(), static_cast<std::size_t>(4 + record.births - record.deaths));
}

TEST(Events, HaveTheSameBitsHoweverTheyAreComputed) {
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        Cover cover;
        const TissueRecord record = cover.grown(precision);
        cover.schedule().threads = 2;
        expect_equal_records(cover.grown(precision), record);
        for (const double skin : {0.0, 0.02, 0.5, 2.0}) {
            SCOPED_TRACE(skin);
            cover.schedule().skin = skin;
            expect_equal_records(cover.grown(precision), record);
        }
        expect_equal_records(cover.grown(precision, 1), record);
        expect_equal_records(cover.grown(precision, 7), record);
    }
}

TEST(RandomDirection, IsUniform) {
    Vector3d sum;
    double squares_of_z = 0;
    constexpr std::uint32_t count = 20000;
    for (std::uint32_t k = 0; k < count; ++k) {
        const Vector3d direction = random_direction({3, 0, k, k + 1}, {});
        EXPECT_NEAR(length(direction), 1, 1e-12);
        sum = sum + direction;
        squares_of_z += direction.z * direction.z;
    }
    EXPECT_LT(length(sum) / count, 0.02);
    EXPECT_NEAR(squares_of_z / count, 1.0 / 3, 0.01);
}

TEST(RandomDirection, IsInThePlane) {
    const Vector3d normal = unit(Vector3d{1, 2, -3});
    std::array<int, 4> quarters{};
    const Vector3d x = unit(cross(normal, Vector3d{1, 0, 0})), y = cross(normal, x);
    for (std::uint32_t k = 0; k < 4000; ++k) {
        const Vector3d direction = random_direction({3, 1, k, k}, normal);
        EXPECT_NEAR(dot(direction, normal), 0, 1e-12);
        ++quarters[(dot(direction, x) > 0 ? 1U : 0U) + (dot(direction, y) > 0 ? 2U : 0U)];
    }
    for (const int count : quarters) EXPECT_NEAR(count, 1000, 120);
    EXPECT_NE(random_direction({3, 1, 5, 6}, normal), random_direction({4, 1, 5, 6}, normal));
    EXPECT_NE(random_direction({3, 1, 5, 6}, normal), random_direction({3, 2, 5, 6}, normal));
}

}  // namespace
}  // namespace cascade::test
