// The border of a mask with values, slopes and fluxes, compared with sides of a grid and with
// theory.

#include "box_runs.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace cascade {
namespace {

using test::expect_box_is_grid;
using test::finished_script;
using test::Operator;
using test::operators_of_planes;
using test::sum_of;

const char* const rules[] = {
    "u.WALL: fixed(0.3)\nv.WALL: slope(-0.2)\n",
    "u.WALL: fixed(k)\n",
    "u.WALL: slope(0.1 * v - u)\nv.WALL: fixed(u^2 + sin(t))\n",
};

TEST(Border, OfABoxIsTheSidesOfTheSmallGridToTheBit) {
    for (const Operator& each : operators_of_planes) {
        for (const std::string rule : rules) {
            expect_box_is_grid(each.rates + rule, "iterations: 7; speed: 0.01", {32, 24, 1},
                               {16, 8, 1}, {5, 7, 0}, each.name + (", " + rule));
        }
    }
}

TEST(Border, OfABoxInAVolumeOrALineIsItsSides) {
    for (const std::string rule : rules) {
        expect_box_is_grid("u' = lap(u + v * lap(v))\nv' = dx(u) + div(k * grad(v))\n" + rule,
                           "iterations: 7; speed: 0.01", {64, 1, 1}, {16, 1, 1}, {9, 0, 0}, rule);
        expect_box_is_grid(
            "u' = lap(u) + dxz(v) - dyz(k * u)\nv' = div(u * grad(v)) + grad2(u) + dxy(v)\n" + rule,
            "iterations: 5; speed: 0.01", {16, 8, 16}, {8, 4, 8}, {3, 2, 5}, rule);
    }
}

TEST(Border, FluxesAndDefinitionsAreThoseOfSides) {
    for (
        const std::string rates :
        {"u' = k * lap(u)\nv' = div((1 + v^2) * grad(v))\nu.WALL: flux(0.2 * v)\nv.WALL: flux(-k)\n",
         "u' = div(tensor(1, 0.2, u) * grad(v))\nv' = div(symmetric(1 + u^2, 0.1 * u, 1) * grad(u))\n"
         "u.WALL: fixed(0.4)\nv.WALL: slope(0.1)\n",
         "w = u^3 - u - lap(u)\nu' = lap(w)\nv' = 0\nw.WALL: slope(0.1)\n",
         "w = u * v\nu' = lap(w)\nv' = lap(v) + dxy(w)\nw.WALL: fixed(0.2 * sin(t))\n"
         "v.WALL: flux(0.1)\n"}) {
        expect_box_is_grid(rates, "iterations: 7; speed: 0.01", {32, 24, 1}, {16, 8, 1}, {5, 7, 0},
                           rates);
    }
}

TEST(Border, SolversTakeTheStepsOfTheSmallGrid) {
    for (const char* stage :
         {"iterations: 9; speed: 0.05; solver: rk4",
          "iterations: 9; speed: 0.05; solver: symplectic",
          "duration: 5; speed: auto; solver: rkl2", "duration: 2; speed: auto",
          "duration: 1; solver: rk45", "iterations: 9; speed: 0.05; frozen: [p] > 3 and [q] < 5"}) {
        expect_box_is_grid(
            "u' = 0.5 * lap(u) - u + v\nv' = lap(v) - v^3\n"
            "u.WALL: slope(-2 * u)\nv.WALL: fixed(0.1 * t)\n",
            stage, {32, 24, 1}, {16, 8, 1}, {5, 7, 0}, stage);
    }
}

TEST(Border, AConstraintHoldsTheSidesOfTheSmallGrid) {
    for (const std::string rule : {"fixed(0.5)", "fixed(k)"}) {
        const auto script = [&](const char* size, const char* shift, const char* rest,
                                const char* wall) {
            return fmt::format(
                "domain {{ grid: {0}; spacing: 0.1; {2} }}\nsystem s {{\n"
                "  p: round(10 * domain.x - 0.5 - {1}); q: round(10 * domain.y - 0.5 - {1})\n"
                "  u: 0\n  k: 0.1 * p - 0.05 * q\n  0 = lap(phi) - sin(p) + 0.1 * q\n"
                "  phi.{3}: {4}\n  u' = phi\n}}\nstage only: s {{ iterations: 1; speed: 1 }}\n",
                size, shift, rest, wall, rule);
        };
        const auto masked = finished_script(
            script("32, 32", "8", "mask: abs(domain.x - 1.6) < 0.8 and abs(domain.y - 1.6) < 0.8",
                   "border"));
        const auto plain = finished_script(script("16, 16", "0", "boundary: noflux", "sides"));
        ASSERT_EQ(masked->failure + plain->failure, "");
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 16; ++i) {
                ASSERT_NEAR(masked->field("u").at(i + 8, j + 8), plain->field("u").at(i, j), 1e-4)
                    << rule << " " << i << " " << j;
            }
        }
    }
}

/// The inflow is the flux times the length of the border. The border is a staircase: its length is
/// the number of faces between a cell inside and a cell outside.
TEST(Border, AFluxAddsTheLengthOfTheStaircase) {
    const int size = 40;
    const auto script = [size](const char* rates) {
        return fmt::format(
            "domain {{ grid: {0}, {0}; spacing: 0.5; mask: hypot(domain.x - 10, domain.y - 9) < 6 "
            "and not disc(0.4, 0.5, 0.1) }}\n"
            "system s {{\n  u: 1 + random(0, 0.5)\n  one: 1\n{1}}}\n"
            "stage only: s {{ iterations: 400; speed: 0.01 }}\n",
            size, rates);
    };
    for (const char* rates : {"  u' = lap(u)\n  u.border: flux(0.3)\n",
                              "  u' = div((1 + u^2) * grad(u))\n  u.border: flux(0.3)\n",
                              "  u' = 2 * lap(u)\n  u.border: slope(0.15)\n"}) {
        const auto start = finished_script(script("  u' = 0\n"));
        const auto end = finished_script(script(rates));
        ASSERT_EQ(end->failure, "");
        const Field& inside = start->field("u");  // 0 outside.
        int faces = 0;
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const bool is_inside = inside.at(i, j) != 0;
                if (i + 1 < size) faces += is_inside != (inside.at(i + 1, j) != 0);
                if (j + 1 < size) faces += is_inside != (inside.at(i, j + 1) != 0);
            }
        }
        ASSERT_GT(faces, 80);
        const double grown = (sum_of(end->field("u")) - sum_of(inside)) * 0.25;  // Times an area.
        EXPECT_NEAR(grown, 0.3 * faces * 0.5 * 4, 2e-4 * grown) << rates;
    }
}

/// At the border, one species gains what another one loses.
TEST(Border, AMembraneKeepsTheSum) {
    const auto script = [](int steps) {
        return fmt::format(
            "domain {{ grid: 40, 40; boundary: noflux; mask: noise(0.2) > -0.1 }}\n"
            "system s {{\n  c: 1 + random(0, 0.5)\n  w: 0\n  inward = 0.3 * (w - c)\n"
            "  c' = 0.5 * lap(c)\n  w' = 0.1 * lap(w)\n"
            "  c.border: flux(inward)\n  w.border: flux(-inward)\n}}\n"
            "stage only: s {{ iterations: {}; speed: 0.2 }}\n",
            steps);
    };
    const auto before = finished_script(script(0)), after = finished_script(script(300));
    const double sum = sum_of(before->field("c"));
    EXPECT_LT(sum_of(after->field("c")) / sum, 0.9);
    EXPECT_NEAR((sum_of(after->field("c")) + sum_of(after->field("w"))) / sum, 1, 2e-6);
}

/// The slowest wave of a disc that is held at 0 decays at the rate (j / R)², with j the first zero
/// of the Bessel function J0. The border is a staircase, so the error falls with the spacing.
TEST(Border, ADiscHeldAtZeroDecaysAsTheBesselFunction) {
    const auto rate = [](int cells) {
        const auto ran = finished_script(fmt::format(
            "domain {{ grid: {0}, {0}; extent: 2.5, 2.5; precision: double\n"
            "  mask: hypot(domain.x - 1.25, domain.y - 1.25) < 1 }}\n"
            "system s {{\n  u: 1\n  early: sum([u] over domain)\n  u' = lap(u)\n"
            "  u.border: fixed(0)\n}}\n"
            "stage first: s {{ duration: 0.5; speed: auto; solver: rkl2; tolerance: 1e-6 }}\n"
            "stage second: s {{ u: u; duration: 0.25; speed: auto; solver: rkl2; tolerance: 1e-6 }}\n",
            cells));
        EXPECT_EQ(ran->failure, "");
        const auto total = [&](std::uint32_t stage) {
            double sum = 0;
            for (int j = 0; j < cells; ++j) {
                for (int i = 0; i < cells; ++i) sum += ran->field("u", stage).number_at(i, j);
            }
            return sum;
        };
        return std::log(total(0) / total(1)) / 0.25;
    };
    constexpr double theory = 2.404825557695773 * 2.404825557695773;
    const double coarse = std::abs(rate(20) / theory - 1), fine = std::abs(rate(80) / theory - 1);
    EXPECT_LT(coarse, 0.08);
    EXPECT_LT(fine, 0.02);
    EXPECT_LT(fine, coarse / 2);
}

}  // namespace
}  // namespace cascade
