// Diffusion with a direction on models: waves along and across the direction, sums that are
// conserved, and all kinds of cells.
#include "run_fixture.h"
#include "run/domain/model_cells.h"
#include "torus_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cascade {
namespace {

using std::numbers::pi;
using test::Triangles;

/// A mesh of the unit square in the plane z = 0: n · n squares, each cut into two triangles.
std::string square(int n) {
    std::string text;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i)
            text += fmt::format("v {} {} 0\n", i / double{n * 1.0}, j / double{n * 1.0});
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1, b = a + n + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, b + 1, a, b + 1, b);
        }
    }
    return text;
}

class DirectedDiffusionTest : public RunTest {
protected:
    /// Runs one stage of `steps` steps on a domain.
    void run(const std::string& domain, const std::string& system, double speed, int steps,
             std::string_view backend = "interp", const char* precision = "double") {
        script_ = std::make_unique<Script>(
            load(fmt::format("domain {{ {}; precision: {} }}\nsystem s {{\n{}\n}}\n"
                             "stage only: s {{ iterations: {}; speed: {} }}\n",
                             domain, precision, system, steps, speed)));
        ASSERT_TRUE(script_->program) << script_->messages(false);
        auto made = Simulation::create(*script_, {backend, 0, 2});
        ASSERT_TRUE(made) << (made ? "" : made.error().message);
        simulation_ = std::move(*made);
        ASSERT_TRUE(simulation_->start_stage(0));
        before_ = all();
        RunControl control;
        const auto end = simulation_->advance_stage(0, steps, control, {});
        ASSERT_TRUE(end) << end.error().message;
        after_ = all();
        duration_ = speed * steps;
    }

    std::vector<std::vector<double>> all() const {
        std::vector<std::vector<double>> values;
        for (const Field& field : simulation_->state(0).species())
            values.push_back(cell_values(field, *simulation_->domain().model->cells));
        return values;
    }
    std::vector<double> areas() const {
        const auto& spread = simulation_->domain().model->cells->spread();
        return cell_values(spread.planes[static_cast<std::size_t>(ModelPlane::area)],
                           *simulation_->domain().model->cells);
    }
    /// Σ area · a · b.
    double product(const std::vector<double>& a, const std::vector<double>& b) const {
        const std::vector<double> each = areas();
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += each[k] * a[k] * b[k];
        return sum;
    }
    double sum(const std::vector<double>& a) const {
        return product(a, std::vector<double>(a.size(), 1));
    }
    /// The rate at which the starting values of a species decay.
    double rate(std::size_t species) const {
        return -std::log(product(before_[species], after_[species]) /
                         product(before_[species], before_[species])) /
               duration_;
    }

    std::unique_ptr<Script> script_;
    std::unique_ptr<Simulation> simulation_;
    std::vector<std::vector<double>> before_, after_;
    double duration_ = 0;
};

TEST_F(DirectedDiffusionTest, WavesDecayAsAlongAndAcross) {
    ASSERT_TRUE(write_file(path("square.obj"), square(40)));
    const double k = 4 * pi;
    std::array<std::array<double, 2>, 2> errors{};
    const std::array domains{"cells: 1600", "cells: 6400"};
    for (std::size_t n = 0; n < domains.size(); ++n) {
        run(fmt::format("mesh: \"square.obj\"; unit: 1; {}", domains[n]),
            "u: cos(4*pi*x)\n v: cos(4*pi*y)\n theta: along(axis(1, 0, 0))\n"
            "u' = diffuse(u, 2, 1, theta)\n v' = div(tensor(2, 1, theta) * grad(v))",
            1e-5, 100);
        errors[n] = {rate(0) / (4 * k * k) - 1, rate(1) / (k * k) - 1};
        EXPECT_NEAR(errors[n][0], 0, 0.01) << domains[n];
        EXPECT_NEAR(errors[n][1], 0, 0.003) << domains[n];
    }
    // Both errors are of second order. The errors on 6400 cells are below a thousandth, so the
    // irregular places of the cells affect the quotients.
    EXPECT_GT(errors[0][0] / errors[1][0], 3);
    EXPECT_GT(std::abs(errors[0][1] / errors[1][1]), 3);
    for (const char* cells : {"faces", "vertices"}) {
        run(fmt::format("mesh: \"square.obj\"; unit: 1; cells: {}", cells),
            "u: cos(4*pi*x)\n v: cos(4*pi*y)\n"
            "u' = diffuse(u, 2, 1, along(axis(1, 0, 0)))\n"
            "v' = diffuse(v, 2, 1, along(axis(1, 0, 0)))",
            1e-5, 100);
        EXPECT_NEAR(rate(0) / (4 * k * k), 1, 0.1) << cells;
        EXPECT_NEAR(rate(1) / (k * k), 1, 0.05) << cells;
    }
}

TEST_F(DirectedDiffusionTest, AWaveAroundASphereDecaysAsItShould) {
    // Diffusion along the circles of latitude turns e = sin⁴ϑ cos 2φ into 4 sin²ϑ cos 2φ, up to the
    // sign. The integral of the product is 4.5 times the integral of e².
    std::array<double, 2> errors{};
    const std::array<int, 2> counts{2000, 8000};
    for (std::size_t n = 0; n < counts.size(); ++n) {
        run(fmt::format("surface: sphere; unit: 1; cells: {}", counts[n]),
            "u: (nx^2 + nz^2) * (nx^2 - nz^2)\n"
            "u' = diffuse(u, 1, 0, along(vector(nz, 0, -nx)))",
            1e-6, 100);
        errors[n] = rate(0) / 4.5 - 1;
        EXPECT_NEAR(errors[n], 0, 0.02) << counts[n];
    }
    EXPECT_LT(std::abs(errors[1]), 0.5 * std::abs(errors[0]));
}

TEST_F(DirectedDiffusionTest, IsTheSameForATensorThatOnlySeemsToChange) {
    // u has weights that are computed once. The coefficient of w reads a species, so w needs
    // gradients in each step.
    run("surface: creature; cells: 2000",
        "u: noise(0.3)\n w: u\n one: 1\n theta: along(axis(0, 1, 0))\n"
        "u' = diffuse(u, 1.5, 1, theta)\n w' = diffuse(w, 1.5 * one, 1, theta)\n one' = 0",
        0.05, 60);
    double apart = 0, changed = 0;
    for (std::size_t k = 0; k < after_[0].size(); ++k) {
        apart += std::abs(after_[0][k] - after_[1][k]);
        changed += std::abs(after_[0][k] - before_[0][k]);
    }
    EXPECT_GT(apart, 0) << "the formulas differ";
    EXPECT_LT(apart, 0.1 * changed);
}

TEST_F(DirectedDiffusionTest, ASpotBecomesTheEllipseOfItsTensor) {
    // The matrix of second moments grows by 2 t A. The direction rises by 45 degrees to the right.
    // Angles count clockwise from the right, so this is -pi/4.
    ASSERT_TRUE(write_file(path("square.obj"), square(20)));
    constexpr double t = 4e-4;
    for (const char* theta : {"along(axis(1, 1, 0))", "along(vector(-1, -1, 3))", "-pi/4",
                              "along(keys(0.5, 0.5, 0, 2, 2, 1)) + pi", "along(grad(x + y))"}) {
        run("mesh: \"square.obj\"; unit: 1; cells: 6400",
            fmt::format("u: gauss(0.5, 0.5, 0.06)\n px: x\n py: y\n"
                        "u' = diffuse(u, 3, 1, {})\n px' = 0\n py' = 0",
                        theta),
            t / 100, 100);
        const std::vector<double> area = areas();
        const auto moments = [&](const std::vector<double>& u) {
            const std::vector<double>&x = before_[1], &y = before_[2];
            std::array<double, 3> sums{};
            for (std::size_t k = 0; k < u.size(); ++k) {
                const double each = area[k] * u[k], a = x[k] - 0.5, b = y[k] - 0.5;
                sums[0] += each * a * a;
                sums[1] += each * a * b;
                sums[2] += each * b * b;
            }
            const double all = sum(u);
            for (double& each : sums) each /= all;
            return sums;
        };
        const auto first = moments(before_[0]), last = moments(after_[0]);
        EXPECT_NEAR((last[0] - first[0]) / (2 * t), 5, 0.15) << theta;
        EXPECT_NEAR((last[1] - first[1]) / (2 * t), 4, 0.15) << theta;
        EXPECT_NEAR((last[2] - first[2]) / (2 * t), 5, 0.15) << theta;
    }
}

TEST_F(DirectedDiffusionTest, KeepsSumsAndLetsNoWaveGrowOnAnyCells) {
    const Triangles torus = Triangles::torus();
    ASSERT_TRUE(write_file(path("even.obj"), torus.finer().obj()));
    ASSERT_TRUE(write_file(path("slivers.obj"), torus.finer().with_few_slivers().obj()));
    ASSERT_TRUE(write_file(path("bad.obj"), torus.worse().obj()));
    struct Case {
        const char* domain;
        double speed;
    };
    for (const auto& [domain, speed] :
         {Case{"surface: creature; cells: 3000", 0.05},
          Case{"surface: box(1, 2, 1); cells: 2000", 0.05},
          Case{"surface: box; cells: faces", 0.05}, Case{"mesh: \"even.obj\"; cells: faces", 0.05},
          Case{"mesh: \"even.obj\"; cells: vertices", 0.05},
          Case{"mesh: \"slivers.obj\"; cells: faces", 0.01},
          Case{"mesh: \"slivers.obj\"; cells: vertices", 0.01},
          Case{"mesh: \"bad.obj\"; cells: vertices", 1e-3}}) {
        run(domain,
            "u: 1 + noise(0.05)\n v: noise(0.02)\n"
            "u' = div(tensor(4, 0.1, along(axis(1, 2, 3))) * grad(u))\n"
            "v' = diffuse(v, 0, 2 + x, along(curvature_low) + pi/4)",
            speed, 40);
        EXPECT_NEAR(sum(after_[0]) / sum(before_[0]), 1, 1e-11) << domain;
        EXPECT_NEAR(sum(after_[1]) - sum(before_[1]), 0, 1e-9) << domain;
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_LT(product(after_[k], after_[k]), product(before_[k], before_[k]))
                << domain << ' ' << k;
        }
    }
}

TEST_F(DirectedDiffusionTest, OfEqualRatesIsTheLaplacian) {
    for (const char* cells : {"400", "faces", "vertices"}) {
        run(fmt::format("surface: torus(1, 0.4); cells: {}", cells),
            "u: x\n v: x\n u' = diffuse(u, 0.5, 0.5, along(axis(0, 1, 0)))\n v' = 0.25 * lap(v)",
            0.05, 20);
        for (std::size_t k = 0; k < after_[0].size(); ++k)
            ASSERT_NEAR(after_[0][k], after_[1][k], 1e-12) << cells;
    }
}

TEST_F(DirectedDiffusionTest, FollowsAFieldThatTurns) {
    // The direction is along the gradient of a species, or at a right angle to the gradient.
    run("surface: sphere; cells: 2000",
        "v: y\n u: noise(0.1)\n w: u\n s: u\n"
        "u' = diffuse(u, 1, 0.3, along(grad(v)))\n w' = diffuse(w, 1, 0.3, along(axis(0, 1, 0)))\n"
        "s' = diffuse(s, 0.3, 1, along(grad(v)) + pi/2)\n v' = 0",
        0.05, 60);
    double largest = 0, apart = 0;
    for (std::size_t k = 0; k < after_[0].size(); ++k) {
        // Near a pole the gradient of y is so small that rounding determines its direction.
        if (std::abs(before_[0][k]) < 0.05) continue;
        largest = std::max(largest, std::abs(after_[1][k] - after_[2][k]));
        apart = std::max(apart, std::abs(after_[1][k] - before_[1][k]));
        ASSERT_NEAR(after_[1][k], after_[3][k], 1e-9);
    }
    // Another formula computes a tensor that may turn, so the results differ a little.
    EXPECT_LT(largest, 0.2 * apart);
}

TEST_F(DirectedDiffusionTest, AFluxOfAnyVectorIsItsDivergence) {
    // Σ (n × x) · z is a turn about the axis, without a divergence. The tangential part of x − c
    // has the divergence 2 − 2 |x − c| / R = 0 on a sphere about c. z ∇z has |∇z|² − 2 z² / R².
    run("surface: sphere; cells: 6000; unit: 1",
        "turn: 0\n stay: 0\n rise: 0\n px: nx\n py: ny\n pz: nz\n"
        "turn' = div(vector(-ny, nx, 0))\n stay' = div(vector(nx, ny, nz))\n"
        "rise' = div(nz * grad(nz)) - div(vector(nz * dx(nz), nz * dy(nz), nz * dz(nz)))\n"
        "px' = 0\n py' = 0\n pz' = 0",
        1, 1);
    double turn = 0, stay = 0, rise = 0;
    for (std::size_t k = 0; k < after_[0].size(); ++k) {
        turn += std::abs(after_[0][k]);
        stay += std::abs(after_[1][k]);
        rise += std::abs(after_[2][k]);
    }
    const double count = static_cast<double>(after_[0].size());
    EXPECT_LT(turn / count, 0.05);
    EXPECT_LT(stay / count, 0.05);
    EXPECT_LT(rise / count, 0.2);
    EXPECT_NEAR(sum(after_[0]), 0, 1e-10);
}

TEST_F(DirectedDiffusionTest, IsTheSameInterpretedAndCompiled) {
    if (!is_available("jit")) GTEST_SKIP() << "without native code";
    for (const char* rates :
         {"u' = diffuse(u, 2 + v, 0.3, theta - pi/3) + div(u * vector(1, v, 0))\n"
          "v' = div(tensor(1, 0.2, along(grad(u))) * grad(v))",
          "u' = diffuse(u, 2, 0.3, theta - pi/3) + 0.1 * dx(v) + lap(v)\n"
          "v' = 0.5 * div(tensor(1, 0.2 + x, theta) * grad(v))"}) {
        for (const char* domain :
             {"surface: creature; cells: 1500", "surface: box; cells: faces"}) {
            std::array<std::vector<std::vector<double>>, 2> results;
            for (const std::string_view backend : {"interp", "jit"}) {
                run(domain,
                    fmt::format("u: random(0, 1)\n v: noise(0.2)\n"
                                "theta: along(curvature_high(0.1))\n{}",
                                rates),
                    0.005, 30, backend, "single");
                results[backend == "jit" ? 1 : 0] = after_;
            }
            EXPECT_EQ(results[0], results[1]) << rates << ' ' << domain;
        }
    }
}

}  // namespace
}  // namespace cascade
