// Rules at the sides of the domain, compared with calculus: manufactured solutions for every kind
// of side and operator, and values that change with time under every solver. The bits must be the
// same however steps are taken. Solutions in closed form are in tests/scripts/boundaries.
#include "run/simulation/simulation.h"

#include "run/script/script.h"
#include "run/simulation/stage_record.h"
#include "support/kernel_comparison.h"
#include "unit/run/ran_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {
namespace {

using test::same_bits;

double largest_error(const Field& u, const std::function<double(double, double)>& exact) {
    double error = 0;
    const PlaneLayout& layout = u.layout();
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const double sx = (static_cast<double>(i) + 0.5) / static_cast<double>(layout.width);
            const double sy = (static_cast<double>(j) + 0.5) / static_cast<double>(layout.height);
            error = std::max(error, std::abs(u.at(i, j) - exact(sx, sy)));
        }
    }
    return error;
}

/// A solution, its derivatives, and the sides that it fits, in the language.
struct Solution {
    const char* name;
    const char* definitions;  ///< w, w_t, w_x, …
    const char* sides;
    std::function<double(double, double, double)> value;  ///< The solution at x, y, t.
};

Solution wave_of(const char* name, const char* sides) {
    return {name,
            "S = sin(x + y / 2 + t); C = cos(x + y / 2 + t); w_t = C; w_x = C; w_y = C / 2\n"
            "w_xx = -S; w_yy = -S / 4; w_xy = -S / 2\n u: 2 + sin(x + y / 2)\n",
            sides, [](double x, double y, double t) { return 2 + std::sin(x + y / 2 + t); }};
}

std::vector<Solution> solutions() {
    return {
        wave_of("fixed",
                "u.left: fixed(2 + sin(y / 2 + t)); u.right: fixed(2 + sin(1 + y / 2 + t))\n"
                "u.top: fixed(2 + sin(x + t)); u.bottom: fixed(2 + sin(x + 1/2 + t))\n"),
        wave_of("slope",
                "u.left: slope(-cos(y / 2 + t)); u.right: slope(cos(1 + y / 2 + t))\n"
                "u.top: slope(-cos(x + t) / 2); u.bottom: slope(cos(x + 1/2 + t) / 2)\n"),
        wave_of("species",
                "u.left: slope(-cos(y / 2 + t) + 3 * (2 + sin(y / 2 + t) - u))\n"
                "u.right: slope(cos(1 + y / 2 + t) + (2 + sin(1 + y / 2 + t))^2 - u^2)\n"
                "u.top: fixed(2 + sin(x + t)); u.bottom: slope(cos(x + 1/2 + t) / 2 + \n"
                "  exp(-2 - sin(x + 1/2 + t)) - exp(-u))\n"),
        {"noflux",
         "X = cos(pi * x); Y = cos(pi * y); T = cos(t); A = sin(pi * x); B = sin(pi * y)\n"
         "w_t = -X * Y * sin(t); w_x = -pi * A * Y * T; w_y = -pi * X * B * T\n"
         "w_xx = -pi^2 * X * Y * T; w_yy = w_xx; w_xy = pi^2 * A * B * T\n"
         "u: 2 + cos(pi * x) * cos(pi * y)\n",
         "u.sides: noflux\n",
         [](double x, double y, double t) {
             return 2 + std::cos(M_PI * x) * std::cos(M_PI * y) * std::cos(t);
         }},
    };
}

/// An operator, and the exact result of applying it to w.
struct OperatorCase {
    const char* name;
    const char* applied;
    const char* exact;
    double order;
};

constexpr OperatorCase operators[] = {
    {"lap", "lap(u)", "w_xx + w_yy", 2},
    {"div", "div((1 + x * y / 2) * grad(u))",
     "(1 + x * y / 2) * (w_xx + w_yy) + y / 2 * w_x + x / 2 * w_y", 2},
    {"diffuse", "diffuse(u, 1, 0.5, 0.6 + x)",
     "(c^2 + s^2 / 4) * w_xx + (s^2 + c^2 / 4) * w_yy + 1.5 * s * c * w_xy", 2},
    {"advect", "0.01 * lap(u) - advect(1 + y, x - 0.5, u)",
     "0.01 * (w_xx + w_yy) - (1 + y) * w_x - (x - 0.5) * w_y", 1},
};

double error_of(const Solution& solution, const OperatorCase& each, int n) {
    const char* angle =
        std::string(each.name) == "diffuse" ? "c = cos(0.6 + x); s = sin(0.6 + x)\n" : "";
    const Ran ran = run_text(fmt::format(
        "system made {{ {}{}u' = w_t + {} - ({})\n {} }}\n"
        "domain {{ grid: {}, {}; spacing: 1 / {}; boundary: noflux }}\n"
        "stage only: made {{ duration: 0.25; solver: rk4; speed: 0.08 / {} }}\n",
        solution.definitions, angle, each.applied, each.exact, solution.sides, n, n, n, n * n));
    if (!ran.simulation) return NAN;
    EXPECT_EQ(ran.failure, "");
    return largest_error(ran.species(),
                         [&](double x, double y) { return solution.value(x, y, 0.25); });
}

/// Mixed derivatives read cells beyond the corners, whose values are only of first order if sides
/// have values. A coefficient beyond a side is of first order, too, because it is mirrored
/// (spec/domain.md).
double expected_order(const Solution& solution, const OperatorCase& each) {
    const std::string where = fmt::format("{} at {}", each.name, solution.name);
    const bool is_first = where == "diffuse at fixed" || where == "diffuse at species" ||
                          where == "div at slope" || where == "div at species";
    return is_first ? 1 : each.order;
}

/// A flux needs no coefficient beyond the side.
TEST(Boundaries, AFluxIsOfSecondOrderWhereDiffusionVaries) {
    const auto solution = wave_of(
        "flux",
        "u.left: flux(-cos(y / 2 + t)); u.right: flux((1 + y / 2) * cos(1 + y / 2 + t))\n"
        "u.top: flux(-cos(x + t) / 2); u.bottom: flux((1 + x / 2) * cos(x + 1/2 + t) / 2)\n");
    const double coarse = error_of(solution, operators[1], 6);
    const double fine = error_of(solution, operators[1], 12);
    EXPECT_GT(std::log2(coarse / fine), 1.65) << coarse << ", " << fine;
    EXPECT_LT(fine, 0.02);
}

TEST(Boundaries, EveryOperatorAtEveryKindOfSide) {
    for (const Solution& solution : solutions()) {
        for (const OperatorCase& each : operators) {
            const double coarse = error_of(solution, each, 6), fine = error_of(solution, each, 12);
            const double order = std::log2(coarse / fine);
            RecordProperty(fmt::format("{} at {}", each.name, solution.name),
                           fmt::format("order {:.2f}, error {:.2g}", order, fine));
            const double expected = expected_order(solution, each);
            EXPECT_GT(order, expected - 0.35)
                << each.name << " at " << solution.name << ": " << coarse << ", " << fine;
            EXPECT_LT(fine, expected == 1 ? 0.3 : 0.02) << each.name << " at " << solution.name;
        }
    }
}

/// The solution u = x g(t) is linear in x, so operators are exact and all of the error is the
/// solver's.
double error_in_time(const std::string& solver, double step, const std::string& right) {
    const Ran ran =
        run_text(fmt::format("system line {{ u: x; u' = 0.5 * lap(u) + x * 2 * cos(2 * t)\n"
                             "  u.left: fixed(0); u.right: {} }}\n"
                             "domain {{ grid: 8; boundary: noflux }}\n"
                             "stage only: line {{ duration: 4.8; solver: {}; speed: {} }}\n",
                             right, solver, step));
    if (!ran.simulation) return NAN;
    return largest_error(ran.species(), [](double x, double) { return x * (1 + std::sin(9.6)); });
}

TEST(Boundaries, ValuesAreThoseOfTheMomentInEverySweep) {
    struct Case {
        const char* solver;
        double step, order;
    };
    for (const Case& each : {Case{"euler", 0.2, 1},
                             {"symplectic", 0.2, 1},
                             {"rk2", 0.2, 2},
                             {"rk4", 0.6, 4},
                             {"rkl1", 0.2, 1},
                             {"rkl2", 0.1, 2}}) {
        for (const char* right : {"fixed(1 + sin(2 * t))", "slope((1 + sin(2 * t)) / 8)",
                                  "slope((1 + sin(2 * t)) / 8 + 2 * (1 + sin(2 * t) - u))",
                                  "flux((1 + sin(2 * t)) / 16 + 2 * (1 + sin(2 * t) - u))"}) {
            const double coarse = error_in_time(each.solver, each.step, right);
            const double fine = error_in_time(each.solver, each.step / 2, right);
            EXPECT_GT(std::log2(coarse / fine), each.order - 0.35)
                << each.solver << ", " << right << ": " << coarse << ", " << fine;
        }
    }
    for (const char* solver : {"rk23; tolerance: 1e-5", "rk45; tolerance: 1e-5"}) {
        EXPECT_LT(error_in_time(solver, 0.1, "fixed(1 + sin(2 * t))"), 1e-4) << solver;
    }
}

TEST(Boundaries, ASideThatReadsItsSpeciesIsRobins) {
    const Ran ran = run_text(
        "system rod { u: 1; k: 2; u' = lap(u); u.right: slope(-k * u) }\n"
        "domain { grid: 32; spacing: 1/32; boundary: noflux; precision: double }\n"
        "stage only: rod { speed: 1/4096; iterations: 2048 }\n");
    // The same steps by hand. With c the last cell and g the cell beyond the side, the value at the
    // face is (c + g) / 2, so (g - c) / h = -k (c + g) / 2.
    std::vector<double> u(34, 1), next(34);
    const double q = 2 * (1.0 / 32) / 2;
    for (int step = 0; step < 2048; ++step) {
        u[0] = u[1];
        u[33] = u[32] * (1 - q) / (1 + q);
        for (int i = 1; i <= 32; ++i) {
            next[i] = u[i] + (u[i - 1] - 2 * u[i] + u[i + 1]) * 1024 / 4096;
        }
        u.swap(next);
    }
    for (int i = 0; i < 32; ++i) EXPECT_NEAR(ran.species().number_at(i, 0), u[i + 1], 1e-12) << i;
}

/// A script with a value at each of six sides. `and_time` and `and_species` are added to make the
/// values vary.
std::string volume(const std::string& and_time, const std::string& and_species,
                   const std::string& solver) {
    return fmt::format(
        "system s {{ begin: sin(7 * x) * y + z; u: begin; v: x * y\n"
        "  u' = 0.05 * lap(u) + 0.02 * dxy(u) - 0.01 * dyz(u * v); v' = 0.1 * lap(v) + dxz(u) / "
        "50\n"
        "  u.left: fixed(sin(9 * y) * z{0}{2}); u.right: slope(y - z{0}{2}); u.top: slope(sin(x * 8){0}{2})\n"
        "  u.bottom: fixed(x * z{0}{2}); u.front: fixed(x - y{0}{2}); u.back: slope(x * y / 2{0}{2})\n"
        "  v.front: noflux; v.back: fixed(0.25{0}{2}); v.left: fixed(begin{0}{2}); v.right: noflux }}\n"
        "domain {{ grid: 21, 10, 6; boundary: noflux, periodic, noflux }}\n"
        "stage only: s {{ iterations: 25; speed: 0.5; solver: {1}\n"
        "  u.left: fixed(sin(9 * y) * z{0}) }}\n",
        and_time, solver, and_species);
}

TEST(Boundaries, ThreadsLanesAndBreaksChangeNothing) {
    for (const char* of_species : {"", " + 0.1 * u * v", " + exp(-v) - 2 * u / (1 + begin)"}) {
        const std::string text = volume(" * (1 + t * z) + sin(step)", of_species, "rk4");
        const Ran one = run_text(text);
        ASSERT_TRUE(one.simulation);
#if CASCADE_HAS_JIT
        for (const SimulationOptions& options :
             {SimulationOptions{"jit", 4, 3}, SimulationOptions{"jit", 16, 2}}) {
            const Ran other = run_text(text, options);
            EXPECT_EQ(same_bits(one.state().species(), other.state().species()), "");
        }
#endif
        Script script = load_script("test", text, ".");
        auto first = Simulation::create(script, {"interp", 0, 1}).value();
        RunControl control;
        ASSERT_TRUE(first->start_stage(0));
        ASSERT_TRUE(first->advance_stage(0, 11, control, {}));
        auto second = Simulation::create(script, {"interp", 0, 1}).value();
        ASSERT_TRUE(second->start_stage(0));
        restore(*second, 0, record_of(first->state(0), *first->domain().program, 0));
        ASSERT_TRUE(second->advance_stage(0, 25, control, {}));
        EXPECT_EQ(same_bits(one.state().species(), second->state(0).species()), "");
    }
}

#if CASCADE_HAS_JIT
TEST(Boundaries, SpeciesOfOneKernelMayHaveSidesOfDifferentKinds) {
    const std::array<std::string_view, 5> sides = {"sides: periodic", "sides: noflux",
                                                   "sides: fixed(x / 2)", "sides: slope(0.1)",
                                                   "sides: fixed(sin(9 * t))"};
    for (const std::string_view of_u : sides) {
        for (const std::string_view of_v : sides) {
            for (const char* grid : {"17, 9", "64, 5", "16, 6, 3"}) {
                const std::string text = fmt::format(
                    "system s {{ u: x + random(0, 1); v: random(0.5, 0.2); w: y\n"
                    "  u' = 0.1 * lap(u) + 0.02 * dxy(v); v' = lap(v) - u / 9 + w; w' = u * v\n"
                    "  u.{}; v.{} }}\n"
                    "domain {{ grid: {}; boundary: noflux }}\n"
                    "stage only: s {{ iterations: 9; speed: 0.1 }}\n",
                    of_u, of_v, grid);
                const Ran expected = run_text(text);
                ASSERT_TRUE(expected.simulation);
                for (const int lanes : {4, 8, 16}) {
                    const Ran native = run_text(text, {"jit", lanes, 1});
                    EXPECT_EQ(same_bits(expected.state().species(), native.state().species()), "")
                        << text;
                }
            }
        }
    }
}
#endif

/// The value of a function beyond a side is computed from the values of the species beyond that
/// side.
TEST(BeyondSides, FunctionsAreMadeOfWhatStandsThere) {
    const auto after_a_step = [](const std::string& rate, const PlanOptions& planning) {
        SimulationOptions options{"interp", 0, 1};
        options.planning = planning;
        const Ran ran = run_text("system s { u: 1 + x; u' = " + rate +
                                     "\n u.sides: fixed(3) }\n"
                                     "domain { grid: 4; boundary: noflux }\n"
                                     "stage only: s { iterations: 1; speed: 1 }\n",
                                 options);
        return ran.species().at(0, 0);
    };
    const double u0 = 1.125, u1 = 1.375, ghost = 2 * 3 - u0;
    for (const Materialise materialise :
         {Materialise::always, Materialise::never, Materialise::when_cheaper}) {
        const PlanOptions planning{materialise, false, true};
        EXPECT_NEAR(after_a_step("lap(u^2)", planning), u0 + ghost * ghost + u1 * u1 - 2 * u0 * u0,
                    1e-4);
        EXPECT_NEAR(after_a_step("lap(exp(u)) + 0 * mean(exp(u) over domain)", planning),
                    u0 + std::exp(ghost) + std::exp(u1) - 2 * std::exp(u0), 1e-4);
        // Beyond the side, the result of the inner operator is mirrored, but the species are not.
        const double lap0 = ghost + u1 - 2 * u0, lap1 = u0 + 1.625 - 2 * u1;
        EXPECT_NEAR(after_a_step("lap(u^2 - lap(u))", planning),
                    u0 + (ghost * ghost - lap0) + (u1 * u1 - lap1) - 2 * (u0 * u0 - lap0), 1e-4);
    }
}

}  // namespace
}  // namespace cascade
