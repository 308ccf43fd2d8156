// Domains with a mask: which neighbours operators read at its border.

#include "box_runs.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {
namespace {

using test::expect_box_is_grid;
using test::finished_script;
using test::Operator;
using test::operators_of_planes;
using test::sum_of;
using test::system_of;
using test::word;

TEST(Mask, ABoxIsTheSmallGridToTheBit) {
    for (const Operator& each : operators_of_planes) {
        expect_box_is_grid(each.rates, "iterations: 7; speed: 0.01", {32, 24, 1}, {16, 8, 1},
                           {5, 7, 0}, each.name);
    }
}

TEST(Mask, ABoxAtTheSideIsTheSmallGridToTheBit) {
    // The box touches a side of the grid, and the neighbours across this periodic side are outside
    // of the mask.
    for (const Operator& each : operators_of_planes) {
        expect_box_is_grid(each.rates, "iterations: 7; speed: 0.01", {32, 24, 1}, {16, 8, 1},
                           {0, 16, 0}, each.name);
    }
}

TEST(Mask, ABoxOfALineOrAVolumeIsTheSmallGridToTheBit) {
    expect_box_is_grid("u' = lap(u + v * lap(v))\nv' = dx(u) + div(k * grad(v))\n",
                       "iterations: 7; speed: 0.01", {64, 1, 1}, {16, 1, 1}, {9, 0, 0}, "line");
    expect_box_is_grid(
        "u' = lap(u) + dxz(v) - dyz(k * u)\nv' = div(u * grad(v)) + grad2(u) + dxy(v)\n",
        "iterations: 5; speed: 0.01", {16, 8, 16}, {8, 4, 8}, {3, 2, 5}, "volume");
}

TEST(Mask, SolversTakeTheStepsOfTheSmallGrid) {
    for (const char* stage : {"iterations: 9; speed: 0.05; solver: rk4",
                              "iterations: 9; speed: 0.05; solver: symplectic",
                              "duration: 5; speed: auto; solver: rkl2", "duration: 2; speed: auto",
                              "iterations: 9; speed: 0.05; frozen: [p] > 3 and [q] < 5"}) {
        expect_box_is_grid("u' = 0.5 * lap(u) - u + v\nv' = lap(v) - v^3\n", stage, {32, 24, 1},
                           {16, 8, 1}, {5, 7, 0}, stage);
    }
}

/// A mask that contains all cells changes no bit, whatever the sides are.
TEST(Mask, AMaskOfAllCellsIsNone) {
    for (const char* boundary : {"boundary: periodic", "boundary: noflux",
                                 "boundary: noflux, periodic; left: fixed(1); right: slope(0.3)"}) {
        for (const Operator& each : operators_of_planes) {
            std::string system = system_of(each.rates);
            for (const auto& [name, axis] :
                 {std::pair{"p: P", "p: 24 * x"}, {"q: Q", "q: 24 * y"}, {"r: R", "r: 0"}}) {
                system.replace(system.find(name), 4, axis);
            }
            const auto script = [&](const char* mask) {
                return fmt::format(
                    "domain {{ grid: 24, 20; {}; {} }}\n{}"
                    "stage only: s {{ iterations: 5; speed: 0.01 }}\n",
                    boundary, mask, system);
            };
            const auto plain = finished_script(script("seed: 1"));
            const auto masked = finished_script(script("mask: 2 + x"));
            for (const std::string name : {"u", "v"}) {
                int wrong = 0;
                for (std::int64_t row = 0; row < 20; ++row) {
                    for (std::int64_t i = 0; i < 24; ++i) {
                        wrong += word(plain->field(name).at(i, row)) !=
                                 word(masked->field(name).at(i, row));
                    }
                }
                EXPECT_EQ(wrong, 0) << each.name << ", " << boundary;
            }
        }
    }
}

/// A blob that reaches across periodic sides gives the same values as the same blob in the middle
/// of the grid.
TEST(Mask, TheOppositeSideIsBeside) {
    constexpr int side = 32;
    const auto script = [&](int across, int down) {
        return fmt::format(
            "domain {{ grid: {0}, {0}; mask: hypot(mod({0} * x - {1}, {0}) - 16, "
            "mod({0} * y - {2}, {0}) - 16) < 9 or abs(mod({0} * y - {2}, {0}) - 12) < 1 }}\n"
            "system s {{\n  p: mod({0} * x - {1}, {0}); q: mod({0} * y - {2}, {0})\n"
            "  u: sin(p + 2 * q); v: cos(p - q)\n"
            "  u' = lap(u * v) + dxy(u)\n  v' = div(tensor(1, 0.2, u) * grad(v)) + dx(u)\n}}\n"
            "stage only: s {{ iterations: 6; speed: 0.01 }}\n",
            side, across, down);
    };
    const auto there = finished_script(script(0, 0));
    const auto here = finished_script(script(13, 20));
    for (const std::string name : {"u", "v"}) {
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                ASSERT_EQ(word(there->field(name).at(i, j)),
                          word(here->field(name).at((i + 13) % side, (j + 20) % side)))
                    << name << " " << i << " " << j;
            }
        }
    }
}

/// Mixed derivatives at the corners of a border favour neither axis.
TEST(Mask, MixedDerivativesFavourNoAxis) {
    const auto script = [](const char* x, const char* y) {
        return fmt::format(
            "domain {{ grid: 30, 30; mask: sin(17 * {0} + 3 * {1}) + cos(19 * {1} * {0}) > -0.4 "
            "}}\n"
            "system s {{\n  u: sin(5 * {0} + 9 * {1}) + {0}\n  u' = dxy(u)\n}}\n"
            "stage only: s {{ iterations: 1 }}\n",
            x, y);
    };
    const auto one = finished_script(script("x", "y"));
    const auto other = finished_script(script("y", "x"));
    for (int j = 0; j < 30; ++j) {
        for (int i = 0; i < 30; ++i) {
            ASSERT_EQ(word(one->field("u").at(i, j)), word(other->field("u").at(j, i)));
        }
    }
}

TEST(Mask, FluxesLoseNothing) {
    for (const char* rate : {"lap(u)", "lap(u^3 - u - 0.5 * lap(u))", "div((1 + u^2) * grad(u))",
                             "div(tensor(1, 0.2, 3 * x) * grad(u))",
                             "div(u * vector(sin(9 * y), 1))", "-div(u * grad(lap(u)))"}) {
        for (const char* domain :
             {"grid: 48, 40; mask: disc(0.4, 0.3, 0.33) and not disc(0.5, 0.4, 0.1)",
              "grid: 40, 40; boundary: noflux; mask: noise(0.2) > -0.1",
              "grid: 40, 40; spacing: 0.8; mask: noise(0.1) > -0.1"}) {
            const auto text = [&](int steps) {
                return fmt::format(
                    "domain {{ {} }}\nsystem s {{\n  u: 1 + random(0, 0.5)\n"
                    "  u' = {}\n}}\nstage only: s {{ iterations: {}; speed: 0.002 }}\n",
                    domain, rate, steps);
            };
            const double before = sum_of(finished_script(text(0))->field("u"));
            const auto after = finished_script(text(400));
            ASSERT_EQ(after->failure, "");
            EXPECT_NEAR(sum_of(after->field("u")) / before, 1, 2e-6) << rate << " in " << domain;
        }
    }
}

/// On a surface the sum of the values, weighted by the cells' areas, does not change.
TEST(Mask, FluxesOnASurfaceLoseNothing) {
    for (const char* rate :
         {"lap(u)", "div(u * vector(sin(9 * sy), 1))", "div(tensor(1, 0.3, 5 * sx) * grad(u^2))"}) {
        const auto ran = finished_script(fmt::format(
            "domain {{\n  grid: 40, 32\n  mask: noise(0.3) > -0.2\n"
            "  surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * sin(2*pi*sx), "
            "sin(2*pi*sy)\n}}\n"
            "system s {{\n  u: 1 + random(0, 0.5)\n  total: sum([u] over domain)\n  u' = {}\n}}\n"
            "stage before: s {{ iterations: 400; speed: 0.01 }}\n"
            "stage after: s {{ iterations: 0; u: u }}\n",
            rate));
        ASSERT_EQ(ran->failure, "");
        EXPECT_NE(ran->field("u").at(20, 16), 0);
        EXPECT_NEAR(ran->number("total", 1) / ran->number("total", 0), 1, 3e-6) << rate;
    }
}

/// A flat surface of square cells gives the values of the plane, also with a mask.
TEST(Mask, AFlatSurfaceIsThePlane) {
    const auto script = [](const char* surface) {
        return fmt::format(
            "domain {{ grid: 24, 20; boundary: noflux; mask: disc(0.4, 0.3, 0.3) and x < 0.6{} }}\n"
            "system s {{\n  u: sin(9 * x + 3 * y)\n  v: cos(7 * y)\n"
            "  u' = lap(u) + grad2(v) + diffuse(v, 1, 0.4, 0.7)\n  v' = div(u * grad(v)) + "
            "dx(u)\n}}\n"
            "stage only: s {{ iterations: 10; speed: 0.05 }}\n",
            surface);
    };
    const auto plane = finished_script(script(""));
    const auto surface = finished_script(script("; surface: 24 * sx, 20 * sy, 0; unit: 1"));
    for (const std::string name : {"u", "v"}) {
        for (int j = 0; j < 20; ++j) {
            for (int i = 0; i < 24; ++i) {
                EXPECT_NEAR(plane->field(name).at(i, j), surface->field(name).at(i, j), 2e-5)
                    << name << " " << i << " " << j;
            }
        }
    }
}

}  // namespace
}  // namespace cascade
