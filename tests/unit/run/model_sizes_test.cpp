// Models whose cells do not fill the last row of memory: every function is finite in that row, and
// the copies that fill the row count nowhere.
#include "model_runs.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace cascade {
namespace {

using test::ModelRun;

constexpr std::array sizes_of_models{600, 1000, 4000};

/// Each of these is the rate of a species.
constexpr std::array rates_on_models{
    "abs(u) + exp(-u) + log(u) + sqrt(u) + cbrt(u) + hypot(u, x) + pow(u, 1.5) + u^3 + 1 / u",
    "sin(x) + cos(y) + tan(z) + asin(u) + acos(u) + atan(u) + atan2(y, x)",
    "sinh(u) + cosh(u) + tanh(u) + sign(u) + floor(u) + ceil(u) + round(u) + mod(u, 0.3)",
    "min(u, x) + max(u, x) + clamp(u, 0, 1) + step(0.5, u) + smoothstep(0, 1, u) + mix(x, y, u)",
    "if(u > 0.5 and not x < 0 or y == 0, u, -u)",
    "lap(u) + grad2(u) + dx(u) + dy(u)",
    "diffuse(u, 2, 1, 0.3) + diffuse(u, 2, 1, along(axis(0, 0, 1)))",
    "div((1 + x^2) * grad(u)) + div(tensor(2, 1, 0.3) * grad(u))",
    "dot(grad(u), grad(x)) + length(grad(u))",
    "random(0, 1) + normal(0, 1) + white(0.01) + white(0)",
    "noise(0.2) + noise(0.2, 3) + lattice(0.3, 0.1) + lattice(0.3, 0.1, 0.5) + diamond(0.3, 0.1)",
    "disc(0.5, 0.5, 0.5, 0.2) + ring(0.5, 0.5, 0.5, 0.3, 0.1) + box(0.5, 0.5, 0.5, 1, 1, 0.2)",
    "gauss(0.5, 0.5, 0.5, 0.2) + stripe(0.5, 0.2) + stripe(0.5, 0.2, 0.4)",
    "distance(0, 0, 1) + keys(0, 0, 1, 2, 1, 0, 0, 3)",
    "nx + ny + nz + curvature + curvature_mean + curvature_gauss + sx + sy + sz + x + y + z",
    "mean(u over domain) + min(u over domain) + max(u over domain) + integral(u over domain)",
};

TEST(ModelSizes, EveryFunctionIsFiniteOnEverySize) {
    for (const std::string& backend : available_backends()) {
        for (const int cells : sizes_of_models) {
            std::string text = fmt::format(
                "domain {{ surface: sphere; cells: {}; unit: 1 }}\n"
                "system s {{ u: 0.5 + 0.2 * noise(0.4)\n",
                cells);
            for (std::size_t k = 0; k < rates_on_models.size(); ++k) {
                text += fmt::format("u{}: 0\nu{}' = {}\n", k, k, rates_on_models[k]);
            }
            text += "u' = 0 }\nstage only: s { iterations: 3; speed: 1e-4 }\n";
            ModelRun run(text, Precision::single, {backend, 0, 2});
            run.start();
            ASSERT_TRUE(run.steps(3)) << cells;
            for (std::size_t k = 0; k < rates_on_models.size(); ++k) {
                for (const double value : run.values(fmt::format("u{}", k))) {
                    ASSERT_TRUE(std::isfinite(value)) << cells << ' ' << rates_on_models[k];
                }
            }
        }
    }
}

TEST(ModelSizes, SumsOverTheDomainAreThoseOfTheSurface) {
    for (const int cells : sizes_of_models) {
        ModelRun run(fmt::format("domain {{ surface: torus; cells: {}; unit: 1 }}\n"
                                 "system s {{ n: 0\n area: 0\n middle: 0\n"
                                 "n' = sum(1 over domain)\n area' = integral(1 over domain)\n"
                                 "middle' = mean(x over domain) }}\n"
                                 "stage only: s {{ iterations: 1; speed: 1 }}\n",
                                 cells),
                     Precision::binary64);
        run.start();
        ASSERT_TRUE(run.steps(1));
        EXPECT_NEAR(run.number("n"), run.area_sum(""), 1e-9 * run.area_sum(""));
        EXPECT_NEAR(run.number("area"), run.area_sum(""), 1e-9 * run.area_sum(""));
        EXPECT_NEAR(run.number("middle"), 0.5, 0.02) << cells;
    }
}

TEST(ModelSizes, WhiteNoiseIsAsStrongOnEverySize) {
    // u' = -k u + white(s) by Euler's steps: the variance of u is s² dt / (area (1 − (1 − k dt)²)).
    constexpr double k = 2, s = 0.5, dt = 0.05;
    for (const char* cells : {"600", "1000", "1024", "faces"}) {
        ModelRun run(fmt::format("domain {{ surface: sphere; cells: {}; unit: 1 }}\n"
                                 "system ou {{ u: 0; u' = -2 * u + white(0.5) }}\n"
                                 "stage only: ou {{ iterations: 200; speed: {} }}\n",
                                 cells, dt),
                     Precision::binary64);
        run.start();
        ASSERT_TRUE(run.steps(200));
        const std::vector<double> values = run.values("u"), areas = run.areas();
        double sum = 0;
        for (std::size_t cell = 0; cell < values.size(); ++cell) {
            sum += areas[cell] * values[cell] * values[cell];
        }
        const double variance = sum / static_cast<double>(values.size());
        const double expected = s * s * dt / (1 - (1 - k * dt) * (1 - k * dt));
        // The relative standard deviation of a variance of n draws is √(2 / n).
        const double deviation = std::sqrt(2 / static_cast<double>(values.size()));
        EXPECT_NEAR(variance / expected, 1, 4 * deviation) << cells;
    }
}

}  // namespace
}  // namespace cascade
