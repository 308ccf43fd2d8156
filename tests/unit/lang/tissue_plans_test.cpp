// Plans of cells that crawl, run by the interpreter in double precision, compared with sums over
// all pairs.
#include "pairs_of_cells.h"

#include "ir/loop_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade::test {
namespace {

constexpr double rounding = 1e-14;

/// A script with one block of cells on a sphere, or another domain.
std::string cells(const std::string& statements, const std::string& domain = "surface: sphere") {
    return "cells c {\n" + statements + "\n}\ndomain { " + domain +
           "; precision: double }\nstage s: c { founders: 2; duration: 1 }\n";
}

TEST(TissuePlans, PushTwoCellsApart) {
    HandMadeTissue tissue(cells("p' += push(0.5)"), {{0.4, 0.5, 0.5}, {0.4, 0.62, 0.59}});
    // The cells are 0.15 apart and overlap by 0.05. The direction from one to the other is (0, 0.8,
    // 0.6).
    expect_near(tissue.rate("p.x"), {0, 0}, rounding);
    expect_near(tissue.rate("p.y"), {-0.02, 0.02}, rounding);
    expect_near(tissue.rate("p.z"), {-0.015, 0.015}, rounding);
}

TEST(TissuePlans, LeaveAHexagonalPatchAtRest) {
    std::vector<Vector3d> places{{0.5, 0.5, 0.5}};
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        places.push_back({0.5 + 0.2 * std::cos(angle), 0.5 + 0.2 * std::sin(angle), 0.5});
    }
    HandMadeTissue tissue(cells("p' += push(0.5) + stick(0.2)"), places);
    for (const char* part : {"p.x", "p.y", "p.z"}) {
        expect_near(tissue.rate(part), Values(places.size(), 0), 1e-16);
    }
}

TEST(TissuePlans, TakeTheNearestImageOnAPeriodicPlane) {
    const std::string script =
        cells("a: 0; a' = sum(distance over near(0.3)); p' = sum(direction over near(0.3))",
              "grid: 64, 32");
    // The cells are neighbours across the side: 0.1 apart along x, whose axis has the length 1, and
    // 0.06 along y, whose axis has the length 1/2.
    HandMadeTissue across_x(script, {{0.96, 0.2, 0}, {0.06, 0.2, 0}});
    expect_near(across_x.rate("a"), {0.1, 0.1}, rounding);
    expect_near(across_x.rate("p.x"), {1, -1}, rounding);
    HandMadeTissue across_y(script, {{0.5, 0.02, 0}, {0.5, 0.46, 0}});
    expect_near(across_y.rate("a"), {0.06, 0.06}, rounding);
    expect_near(across_y.rate("p.y"), {-1, 1}, rounding);
    const std::string walled =
        cells("a: 0; a' = sum(distance over near(2))", "grid: 64, 32; boundary: noflux");
    HandMadeTissue beside(walled, {{0.96, 0.2, 0}, {0.06, 0.2, 0}});
    expect_near(beside.rate("a"), {0.9, 0.9}, rounding);
}

TEST(TissuePlans, MakeAxesOfAnyQuaternion) {
    std::string statements;
    for (const std::string axis : {"x", "y", "z"}) {
        for (const std::string part : {"x", "y", "z"}) {
            const std::string name = axis + "_" + part;
            statements += name + ": 0; " + name + "' = dot(e" + axis + ", vector(" +
                          (part == "x"   ? "1, 0, 0"
                           : part == "y" ? "0, 1"
                                         : "0, 0, 1") +
                          "))\n";
        }
    }
    HandMadeTissue tissue(cells(statements), random_places(20, 3));
    turn_at_random(tissue, 4);
    const std::array<Vector3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const std::array<std::string, 3> names{"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t part = 0; part < 3; ++part) {
            Values expected;
            for (std::size_t cell = 0; cell < tissue.size(); ++cell) {
                expected.push_back(dot(axis_of(tissue, cell, axes[axis]), axes[part]));
            }
            expect_near(tissue.rate(names[axis] + "_" + names[part]), expected);
        }
    }
}

/// A vector turned about an axis by an angle, both given by `turn`: Rodrigues' formula.
Vector3d turned(const Vector3d& v, const Vector3d& turn) {
    const double angle = length(turn);
    if (angle == 0) return v;
    const Vector3d axis = (1 / angle) * turn;
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (dot(axis, v) * (1 - std::cos(angle))) * axis;
}

TEST(TissuePlans, TurnOneDirectionToAnother) {
    std::string statements = "turn_of = toward(ey, normal)\n";
    for (const std::string part : {"x", "y", "z"}) {
        statements += part + "w: 0; " + part + "w' = dot(turn_of, vector(" +
                      (part == "x"   ? "1, 0, 0"
                       : part == "y" ? "0, 1"
                                     : "0, 0, 1") +
                      "))\n";
    }
    HandMadeTissue tissue(cells(statements), random_places(40, 5));
    turn_at_random(tissue, 6);
    // The last cell is already upright.
    const std::size_t last = tissue.size() - 1;
    tissue.values("frame.w")[last] = 1;
    for (const char* part : {"frame.x", "frame.y", "frame.z"}) tissue.values(part)[last] = 0;
    RandomStream random(7);
    std::vector<Vector3d> normals;
    for (std::size_t cell = 0; cell < tissue.size(); ++cell) {
        const auto number = [&] { return static_cast<double>(random.symmetric()); };
        const Vector3d any{number(), number(), number()};
        normals.push_back(cell == last ? Vector3d{0, 1, 0} : (1 / length(any)) * any);
        tissue.sensed(ModelPlane::nx)[cell] = normals[cell].x;
        tissue.sensed(ModelPlane::ny)[cell] = normals[cell].y;
        tissue.sensed(ModelPlane::nz)[cell] = normals[cell].z;
    }
    const Values x = tissue.rate("xw"), y = tissue.rate("yw"), z = tissue.rate("zw");
    for (std::size_t cell = 0; cell < tissue.size(); ++cell) {
        const Vector3d turn{x[cell], y[cell], z[cell]};
        const Vector3d ey = axis_of(tissue, cell, {0, 1, 0});
        EXPECT_NEAR(length(turned(ey, turn) - normals[cell]), 0, 1e-12) << cell;
        EXPECT_NEAR(dot(turn, ey), 0, 1e-12) << "the shortest way";
        EXPECT_LE(length(turn), std::numbers::pi + 1e-12);
    }
    EXPECT_EQ(length(Vector3d{x[last], y[last], z[last]}), 0);
}

class RandomTissue : public ::testing::Test {
protected:
    HandMadeTissue tissue_of(const std::string& statements, std::size_t count = 60) const {
        HandMadeTissue tissue(cells("r: 0.1 in 0 .. 1; q: 0; q' = 0\n" + statements),
                              random_places(count, 8));
        tissue.values("p.x")[1] = 3;  // Touches no other cell.
        RandomStream random(9);
        for (std::size_t cell = 0; cell < count; ++cell) {
            tissue.values("r")[cell] = 0.1 + 0.04 * static_cast<double>(random.symmetric());
            tissue.values("q")[cell] = static_cast<double>(random.symmetric());
        }
        return tissue;
    }
};

TEST_F(RandomTissue, SumsWhatTouches) {
    HandMadeTissue tissue = tissue_of(
        "a: 0; a' = sum(contact * (q - own(q)) over touching)\n"
        "b: 0; b' = lap(q)\n"
        "c: 0; c' = mean(q over touching)\n"
        "d: 0; d' = sum(overlap * gap + own(r) * r over touching)\n"
        "e: 0; e' = bound(q, q + 1)\n");
    const auto q = [&](std::size_t cell) { return tissue.values("q")[cell]; };
    const auto r = [&](std::size_t cell) { return tissue.values("r")[cell]; };
    const auto touching = [&](const Term& term) { return summed(tissue, default_reach, term); };
    const Values flow =
        touching([&](auto i, auto j) { return contact_of(tissue, i, j) * (q(j) - q(i)); });
    expect_near(tissue.rate("a"), flow);
    EXPECT_EQ(tissue.rate("b"), tissue.rate("a"));
    Values mean = touching([&](auto, auto j) { return q(j); });
    const Values count = touching([](auto, auto) { return 1; });
    EXPECT_EQ(count[1], 0);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] /= std::max(count[k], 1.0);
    expect_near(tissue.rate("c"), mean);
    expect_near(tissue.rate("d"), touching([&](auto i, auto j) {
                    const double gap = distance_of(tissue, i, j) - (r(i) + r(j));
                    return std::max(-gap, 0.0) * gap + r(i) * r(j);
                }));
    expect_near(tissue.rate("e"), touching([&](auto i, auto j) {
                    return contact_of(tissue, i, j) * q(i) * (q(j) + 1);
                }));
}

TEST_F(RandomTissue, FindsTheLeastAndTheGreatestNearby) {
    HandMadeTissue tissue = tissue_of(
        "a: 0; a' = min(q over near(0.25))\n"
        "b: 0; b' = max(q * distance over near(0.25))\n"
        "c: 0; c' = max(q over near(0.0001))\n");
    const Values least = tissue.rate("a"), greatest = tissue.rate("b");
    for (std::size_t i = 0; i < tissue.size(); ++i) {
        double low = INFINITY, high = -INFINITY;
        for (std::size_t j = 0; j < tissue.size(); ++j) {
            const double distance = distance_of(tissue, i, j);
            if (i == j || distance >= 0.25) continue;
            low = std::min(low, tissue.values("q")[j]);
            high = std::max(high, tissue.values("q")[j] * distance);
        }
        EXPECT_EQ(least[i], low);
        if (std::isinf(high)) EXPECT_EQ(greatest[i], high);
        else EXPECT_NEAR(greatest[i], high, rounding);
    }
    EXPECT_EQ(tissue.rate("c"), Values(tissue.size(), -INFINITY)) << "of none";
}

TEST_F(RandomTissue, ReadsWhatNeighboursComputeOfTheirs) {
    HandMadeTissue tissue = tissue_of(
        "crowd = sum(contact over touching)\n"
        "heavy = tanh(q) * exp(-q)\n"
        "a: 0; a' = sum(crowd * own(crowd) over touching)\n"
        "b: 0; b' = sum(heavy over touching)\n"
        "c: 0; c' = sum(q' + d' over touching); d: 0; d' = lap(q)\n"
        "draw = random(0, 1)\n"
        "own_draw: 0; own_draw' = draw\n"
        "draws: 0; draws' = sum(draw over touching)\n");
    const auto touching = [&](const Term& term) { return summed(tissue, default_reach, term); };
    const Values crowd = touching([&](auto i, auto j) { return contact_of(tissue, i, j); });
    expect_near(tissue.rate("a"), touching([&](auto i, auto j) { return crowd[i] * crowd[j]; }));
    expect_near(tissue.rate("b"), touching([&](auto, auto j) {
                    const double q = tissue.values("q")[j];
                    return std::tanh(q) * std::exp(-q);
                }));
    const Values flow = tissue.rate("d");
    expect_near(tissue.rate("c"), touching([&](auto, auto j) { return flow[j]; }));
    const Values draw = tissue.rate("own_draw");
    expect_near(tissue.rate("draws"), touching([&](auto, auto j) { return draw[j]; }));
}

TEST_F(RandomTissue, TakesMeansOverAllCells) {
    HandMadeTissue tissue = tissue_of("a: 0; a' = mean(q over domain) + sum(r over domain)", 37);
    double mean = 0, sum = 0;
    for (std::size_t cell = 0; cell < tissue.size(); ++cell) {
        mean += tissue.values("q")[cell] / static_cast<double>(tissue.size());
        sum += tissue.values("r")[cell];
    }
    expect_near(tissue.rate("a"), Values(tissue.size(), mean + sum));
}

TEST_F(RandomTissue, CombsCells) {
    HandMadeTissue tissue = tissue_of("v = mean(ez over touching); a: 0; a' = length(v)\n");
    turn_at_random(tissue, 10);
    Values expected;
    for (std::size_t i = 0; i < tissue.size(); ++i) {
        Vector3d sum{0, 0, 0};
        double count = 0;
        for (std::size_t j = 0; j < tissue.size(); ++j) {
            const double radii = tissue.values("r")[i] + tissue.values("r")[j];
            if (i == j || distance_of(tissue, i, j) >= default_reach * radii) continue;
            sum = sum + axis_of(tissue, j, {0, 0, 1});
            count += 1;
        }
        expected.push_back(length(sum) / std::max(count, 1.0));
    }
    expect_near(tissue.rate("a"), expected);
}

TEST(TissuePlans, ComputeVectors) {
    HandMadeTissue tissue(
        "fn flipped(v, c) = if(c, -v, mix(v, cross(v, vector(0, 0, 1)), 0.25))\n" +
            cells("v = vector(x, 2 * y) / 2 - p * 3\n"
                  "a: 0; a' = dot(flipped(v, x > 0.5), vector(1, 10, 100))\n"
                  "b: 0; b' = length(unit(v)) + length(unit(0 * v))\n"),
        {{0.2, 0.3, 0.4}, {0.7, 0.1, 0.2}});
    const auto v = [&](std::size_t cell) {
        const Vector3d p = tissue.vector("p", cell);
        return 0.5 * Vector3d{p.x, 2 * p.y, 0} - 3.0 * p;
    };
    const Vector3d mixed = 0.75 * v(0) + 0.25 * cross(v(0), Vector3d{0, 0, 1});
    expect_near(tissue.rate("a"),
                {dot(mixed, Vector3d{1, 10, 100}), -dot(v(1), Vector3d{1, 10, 100})});
    expect_near(tissue.rate("b"), {1, 1});
}

TEST(TissuePlans, StartAtGivenPlaces) {
    HandMadeTissue tissue(cells("a: x + 2 * length(p); a' = 0\nr: 0.1 * y"),
                          {{0, 3, 4}, {1, 0, 0}});
    const StepPlan plan = plan_start(tissue.program(), tissue.stage());
    const std::vector<Values> start = tissue.run(plan);
    const System& system = tissue.program().system_of(tissue.stage());
    std::map<std::string, Values> values;
    for (std::size_t k = 0; k < plan.results.size(); ++k) {
        values[std::string(system.item_name(plan.results[k]))] = start[k];
    }
    expect_near(values["a"], {10, 3}, rounding);
    expect_near(values["r"], {0.3, 0}, rounding);
    EXPECT_FALSE(values.contains("p.x"));
    EXPECT_TRUE(values.contains("frame.w"));
}

TEST(TissuePlans, StartAgainAfterADivision) {
    HandMadeTissue tissue(cells("a: 1\na: a / 2 after divide\na' = 1\n"
                                "b: 3 after divide\nb' = 1\nc: 0\nc' = 1\ndivide: a > 1"),
                          {{0, 0, 0}, {1, 0, 0}});
    tissue.values("a") = {4, 6};
    const StepPlan plan = plan_restarts(tissue.program(), tissue.stage());
    const System& system = tissue.program().system_of(tissue.stage());
    ASSERT_EQ(plan.results.size(), 3u);
    const std::vector<Values> values = tissue.run(plan);
    const std::map<std::string, Values> expected{{"age", {0, 0}}, {"a", {2, 3}}, {"b", {3, 3}}};
    for (std::size_t k = 0; k < values.size(); ++k) {
        EXPECT_EQ(values[k], expected.at(std::string(system.item_name(plan.results[k]))));
    }
}

/// The kernel of the last pass of the rates.
CellKernel last_kernel(const std::string& script) {
    const auto checked = check_text(script);
    for (const std::string& fault : checked->faults()) ADD_FAILURE() << fault;
    return *plan_rates(*checked->program, 0).passes.back().bound.kernel;
}

std::ptrdiff_t count_of(const CellKernel& kernel, Op op) {
    return std::ranges::count(kernel.code, op, &Instruction::op);
}

TEST(TissueKernels, GoOverLinksOnce) {
    const CellKernel kernel =
        last_kernel(cells("crowd = sum(contact over touching)\n"
                          "ripe: 0; ripe' = 2 * more(crowd, 2.6) - ripe\n"
                          "p' += cling(1) + push(0.5) + stick(0.05)\n"
                          "turn' += stand(1) + comb(1)\n"));
    const CellSchedule schedule = cell_schedule_of(kernel, loop_levels_of(kernel));
    EXPECT_EQ(schedule.loops.size(), 1u);
    // Position, radius and one axis are gathered once each.
    EXPECT_EQ(count_of(kernel, Op::theirs), 7) << print(kernel);
    // Push, stick, crowd, comb and the number of touching cells.
    EXPECT_EQ(count_of(kernel, Op::link_sum), 3 + 3 + 1 + 3 + 1);
}

TEST(TissueKernels, FindADistanceOnce) {
    const CellKernel kernel =
        last_kernel(cells("p' += push(0.5) + stick(0.05)\n"
                          "a: 0; a' = sum(contact over touching) + max(distance over near(0.1))"));
    EXPECT_EQ(count_of(kernel, Op::square_root), 1);
    EXPECT_EQ(count_of(kernel, Op::theirs), 4);
    // 1/distance, and distance/(r + r') for the contact.
    EXPECT_EQ(count_of(kernel, Op::divide), 2);
}

}  // namespace
}  // namespace cascade::test
