// Equations on models, compared with calculus, from the text of a script to numbers.
#include "model_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using test::ModelRun;

/// A script of one stage whose steps have this length.
std::string script_of_steps(const std::string& domain, const std::string& system, double speed,
                            int steps) {
    return fmt::format(
        "domain {{ {} }}\nsystem s {{ {} }}\n"
        "stage only: s {{ iterations: {}; speed: {} }}\n",
        domain, system, steps, speed);
}

std::string heat(const std::string& domain, const std::string& start, double speed, int steps) {
    return script_of_steps(domain, "u: " + start + "\n u' = lap(u)", speed, steps);
}

/// The rate at which the values `before` have decayed to `after` in the time t.
double decay_rate(const std::vector<double>& before, const std::vector<double>& after, double t) {
    double both = 0, square = 0;
    for (std::size_t k = 0; k < before.size(); ++k) {
        both += before[k] * after[k];
        square += before[k] * before[k];
    }
    return -std::log(both / square) / t;
}

TEST(ModelTheory, HeatOnASphereDecaysByHarmonics) {
    // c' = lap(c) multiplies a harmonic of degree l by exp(−l (l + 1) t). nz, the sine of the
    // latitude, is a harmonic of degree 1.
    constexpr double t = 0.02;
    constexpr int steps = 40;
    struct Case {
        const char* domain;
        double tolerance;
    };
    // Turk's Laplacian treats all cells as equally large hexagons.
    for (const auto& [domain, tolerance] :
         {Case{"cells: 6000", 0.03}, Case{"cells: 6000; laplacian: turk", 0.12},
          Case{"cells: faces", 0.03}, Case{"cells: vertices", 0.03}}) {
        ModelRun run(script_of_steps(fmt::format("surface: sphere; unit: 1; {}", domain),
                                     "p1: nz\n p2: 1.5*nz*nz - 0.5\n p3: 2.5*nz*nz*nz - 1.5*nz\n"
                                     "p1' = lap(p1)\n p2' = lap(p2)\n p3' = lap(p3)",
                                     t / steps, steps));
        run.start();
        std::array<std::vector<double>, 3> before;
        for (std::size_t l = 1; l <= 3; ++l) before[l - 1] = run.values(fmt::format("p{}", l));
        ASSERT_TRUE(run.steps(steps));
        for (std::size_t l = 1; l <= 3; ++l) {
            const double rate = decay_rate(before[l - 1], run.values(fmt::format("p{}", l)), t);
            EXPECT_NEAR(rate / static_cast<double>(l * (l + 1)), 1, tolerance)
                << domain << ' ' << l;
        }
    }
}

TEST(ModelTheory, NothingIsLost) {
    for (const char* surface : {"sphere", "torus(1, 0.3)", "box(1, 1, 2)", "creature"}) {
        ModelRun run(
            script_of_steps(fmt::format("surface: {}; cells: 1300", surface),
                            "k: random(0.5, 0.4)\n n: 1 + noise(0.2)^2\n u: n\n v: n\n w: n\n"
                            "u' = lap(u)\n v' = div((0.5 + k) * grad(v))\n"
                            "w' = div(w^2 * grad(w) - k * grad(w))",
                            0.05, 200),
            Precision::binary64);
        run.start();
        const double sum = run.area_sum("n"), spread = run.spread("n");
        ASSERT_TRUE(run.steps(200));
        for (const char* name : {"u", "v", "w"}) {
            EXPECT_NEAR(run.area_sum(name) / sum, 1, 1e-12) << surface << ' ' << name;
            EXPECT_LT(run.spread(name), 0.7 * spread) << surface << ' ' << name;
        }
    }
}

TEST(ModelTheory, AConstantHasNoDerivatives) {
    for (const char* cells : {"1300", "faces", "vertices"}) {
        ModelRun run(script_of_steps(
            fmt::format("surface: box; cells: {}", cells),
            "k: random(0.5, 0.4)\n c: 0.3 + 0*x\n p: c\n q: c\n r: c\n u: c\n v: c\n w: c\n"
            "p' = lap(p)\n q' = div(k * grad(q))\n r' = grad2(r)\n"
            "u' = dx(u)\n v' = dy(v)\n w' = dz(w)",
            0.125, 3));
        run.start();
        ASSERT_TRUE(run.steps(3));
        for (const char* name : {"p", "q", "r", "u", "v", "w"}) {
            EXPECT_EQ(run.values(name), run.values("c")) << cells << ' ' << name;
        }
    }
}

/// The mean of the absolute values of an item.
double mean_size(const ModelRun& run, const std::string& name) {
    const std::vector<double> values = run.values(name);
    double sum = 0;
    for (const double value : values) sum += std::abs(value);
    return sum / static_cast<double>(values.size());
}

TEST(ModelTheory, GradientsOfLinearFunctions) {
    // x runs from 0 to 1 along the longest side, which is 2 units on a sphere of radius 1. The
    // gradient of f in space is G = (1, -1/2, 3/2), and the gradient on the surface is the
    // tangential part of G.
    ModelRun sphere(script_of_steps(
        "surface: sphere; cells: 6000; unit: 1",
        "f: 2*x - y + 3*z\n n: nx - 0.5*ny + 1.5*nz\n"
        "ex: dx(f) - 1 + nx*n\n ey: dy(f) + 0.5 + ny*n\n ez: dz(f) - 1.5 + nz*n\n"
        "e2: grad2(f) - 3.5 + n^2\n m2: mean(grad2(f) over domain)\n u: 0\n u' = 0*u",
        1, 0));
    sphere.start();
    for (const char* name : {"ex", "ey", "ez"}) EXPECT_LT(mean_size(sphere, name), 0.02) << name;
    // The irregular shapes of cells disturb the flow through single walls, but the mean is right.
    EXPECT_LT(mean_size(sphere, "e2"), 0.25);
    EXPECT_NEAR(sphere.number("m2"), 3.5 * 2 / 3, 0.02);
    // The sides of a box are flat, but cells at its edges have neighbours on two sides.
    ModelRun box(script_of_steps("surface: box(1, 1, 1); cells: 6000; unit: 1",
                                 "f: 2*x - y + 3*z\n ex: dx(f) - 2 * (abs(nx) < 0.5)\n"
                                 "ez: dz(f) - 3 * (abs(nz) < 0.5)\n u: 0\n u' = 0*u",
                                 1, 0));
    box.start();
    EXPECT_LT(mean_size(box, "ex"), 0.08);
    EXPECT_LT(mean_size(box, "ez"), 0.12);
}

TEST(ModelTheory, BothSquaresOfGradientsConverge) {
    // A harmonic of degree 8 on a sphere, about Re (x + iy)^8: |grad f|^2 = 64 (r^14 - f^2).
    const auto errors = [](int cells) {
        ModelRun run(script_of_steps(fmt::format("surface: sphere; unit: 1; cells: {}", cells),
                                     "r2: nx^2 + ny^2\n"
                                     "f: nx^8 - 28*nx^6*ny^2 + 70*nx^4*ny^4 - 28*nx^2*ny^6 + ny^8\n"
                                     "m: mean(64 * (r2^7 - f^2) over domain)\n"
                                     "g: mean(grad2(f) over domain)\n"
                                     "d: mean(dx(f)^2 + dy(f)^2 + dz(f)^2 over domain)\n"
                                     "e: mean(f * lap(f) over domain)\n u: 0\n u' = 0*u",
                                     1, 0),
                     Precision::binary64);
        run.start();
        EXPECT_NEAR(run.number("g") + run.number("e"), 0, 1e-10);  // Integration by parts is exact.
        return std::array{1 - run.number("g") / run.number("m"),
                          1 - run.number("d") / run.number("m")};
    };
    const auto coarse = errors(1250), fine = errors(5000);
    // Both errors are of second order. Differences over two cells have four times the error.
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(coarse[k] / fine[k], 4, 0.6) << k;
    EXPECT_NEAR(coarse[1] / coarse[0], 4, 0.6);
    EXPECT_NEAR(coarse[0], 0.05, 0.005);
}

TEST(ModelTheory, AggregatesCountAreasAndNoCellTwice) {
    // 1300 cells leave 236 places of the last row of memory without a cell.
    ModelRun run(
        "domain { surface: sphere; cells: 1300; unit: 1 }\n"
        "system s { u: sx\n total: sum(1 + 0*u over domain)\n middle: mean(u over domain)\n"
        "  low: min(u over domain)\n high: max(u over domain)\n"
        "  square: mean(nz^2 over domain)\n u' = 0 }\n"
        "stage only: s { iterations: 0 }\n",
        Precision::binary64);
    run.start();
    const std::vector<double> u = run.values("u");
    EXPECT_NEAR(run.number("total"), 4 * std::numbers::pi, 0.02);
    EXPECT_NEAR(run.number("middle"), 0.5, 0.002);
    EXPECT_NEAR(run.number("square"), 1.0 / 3, 0.002);
    EXPECT_EQ(run.number("low"), *std::min_element(u.begin(), u.end()));
    EXPECT_EQ(run.number("high"), *std::max_element(u.begin(), u.end()));
    EXPECT_NEAR(run.number("total"), run.area_sum(""), 1e-9);
}

TEST(ModelTheory, SubstepsAreStepsOfTheirLength) {
    const auto text = [](double speed, int steps) {
        return heat("surface: sphere; cells: 800; unit: 1", "sin(7*x) + noise(0.3)", speed, steps);
    };
    ModelRun whole(text(0.006, 3), Precision::binary64);
    whole.start();
    ASSERT_TRUE(whole.steps(3));
    const std::uint32_t parts = whole.substeps();
    ASSERT_GT(parts, 1u);
    ASSERT_LE(parts, 3u);
    ModelRun shorter(text(0.006 / parts, 3 * static_cast<int>(parts)), Precision::binary64);
    shorter.start();
    ASSERT_TRUE(shorter.steps(3 * static_cast<int>(parts)));
    EXPECT_LE(shorter.substeps(), 1u);
    const std::vector<double> a = whole.values("u"), b = shorter.values("u");
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-12);
}

TEST(ModelTheory, ManyPartsOfAStepAreStagesOfLegendre) {
    // Stages of the Runge-Kutta-Legendre method, like the parts of a step, multiply a mode of rate
    // r by 1 - r h + O(h^2) in a step of length h, and damp the shortest waves.
    constexpr double speed = 0.02;
    ModelRun run(script_of_steps("surface: sphere; cells: 6000; unit: 1",
                                 "p: nz\n rough: noise(0.05)\n p' = lap(p)\n rough' = lap(rough)",
                                 speed, 20));
    run.start();
    const std::vector<double> before = run.values("p");
    const double roughness = run.spread("rough");
    ASSERT_TRUE(run.steps(20));
    EXPECT_GE(run.substeps(), 50u);
    EXPECT_NEAR(decay_rate(before, run.values("p"), 20 * speed), 2, 0.05);
    EXPECT_LT(run.spread("rough"), 0.2 * roughness);
}

TEST(ModelTheory, TuringsSpotsNeedNoSubsteps) {
    for (const char* surface : {"sphere", "torus(1, 0.2)", "box(1, 1, 4)", "creature"}) {
        ModelRun run(
            fmt::format("domain {{ surface: {}; cells: 4000 }}\n"
                        "stage only: turing_spots {{ iterations: 1 }}\n",
                        surface));
        run.start();
        EXPECT_TRUE(run.steps(1));
        EXPECT_LE(run.substeps(), 1u) << surface;
    }
}

}  // namespace
}  // namespace cascade
