// Turing's patterns appear at the threshold and with the wavelength of linear theory.
#include "tests/models/dispersion.h"
#include "tests/models/model.h"

#include "analysis/stage_analysis.h"
#include "measure/spectrum.h"
#include "run/script/script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cascade::models {
namespace {

constexpr std::size_t turing_side = 192;

/// A system of the library with its reaction and diffusion coefficients, written in C++.
struct Case {
    std::string system;
    ReactionDiffusion mathematics;
    State guess;  ///< Where Newton's method begins, near the flat state.
    std::vector<std::string> species;
    double speed;
    /// The relative tolerance of the wavelength, larger if many waves grow at similar rates.
    double tolerance = 0.03;
};

std::vector<Case> cases() {
    return {
        {"brusselator",
         {[](const State& s) {
              return State{4.5 - 8 * s[0] + s[0] * s[0] * s[1], 7 * s[0] - s[0] * s[0] * s[1]};
          },
          {4, 32}},
         {4.5, 1.6},
         {"u", "v"},
         0.005},
        {"schnakenberg",
         {[](const State& s) {
              return State{0.1 - s[0] + s[0] * s[0] * s[1], 0.9 - s[0] * s[0] * s[1]};
          },
          {0.6, 24}},
         {1, 0.9},
         {"u", "v"},
         0.01},
        {"gierer_meinhardt",
         {[](const State& s) {
              return State{0.02 + s[0] * s[0] / s[1] - s[0], s[0] * s[0] - 1.5 * s[1]};
          },
          {1, 30}},
         {1.5, 1.5},
         {"a", "h"},
         0.006},
        {"lengyel_epstein",
         {[](const State& s) {
              const double bound = s[0] * s[1] / (1 + s[0] * s[0]);
              return State{12 - s[0] - 4 * bound, 20 * 0.3 * (s[0] - bound)};
          },
          {1, 32}},
         {2.4, 6.8},
         {"u", "v"},
         0.006},
        {"thomas",
         {[](const State& s) {
              const double used = 13 * s[0] * s[1] / (1 + s[0] + 0.05 * s[0] * s[0]);
              return State{0.5 * (150 - s[0] - used), 0.5 * (1.5 * (100 - s[1]) - used)};
          },
          {1, 40}},
         {37, 25},
         {"u", "v"},
         0.003},
        {"mimura_murray",
         {[](const State& s) {
              return State{((35 + 16 * s[0] - s[0] * s[0]) / 9 - s[1]) * s[0],
                           (s[0] - 1 - 0.4 * s[1]) * s[1]};
          },
          {1.25, 100}},
         {5, 10},
         {"prey", "predator"},
         0.002},
        {"barrio_varea",
         {[](const State& s) {
              const double cubic = 0.899 * 2 * s[0] * s[1] * s[1];
              return State{0.899 * s[0] - cubic + s[1] * (1 - 0.2 * s[0]),
                           -0.91 * s[1] + cubic + s[0] * (-0.899 + 0.2 * s[1])};
          },
          {0.516 * 3, 3}},
         {0, 0},
         {"u", "v"},
         0.05},
        {"digits",
         {[](const State& s) {
              return State{s[1] - s[2] - s[0] * s[0] * s[0], -1.59 * s[0] - 0.1 * s[1],
                           -1.27 * s[0] - 0.1 * s[2]};
          },
          {0, 2.5, 1}},
         {0, 0, 0},
         {"sox9", "bmp", "wnt"},
         0.05,
         0.06},
        {"insect_eyes",
         {[](const State& s) {
              return State{0.067 * s[0] - 0.08 * s[1] + 0.01 - 0.03 * s[0],
                           0.09 * s[0] - 0.07 * s[1] - 0.08 * s[1]};
          },
          {0.02, 0.45}},
         {0.8, 0.5},
         {"a", "b"},
         0.4},
        {"maginu",
         {[](const State& s) {
              return State{0.9 * (s[0] - s[0] * s[0] * s[0]) - s[1], 2 * (s[0] - s[1])};
          },
          {1, 10}},
         {0, 0},
         {"a", "b"},
         0.02},
        {"cubic_coupled_brusselators",
         {[](const State& s) {
              const double first = s[0] * s[0] * s[1], second = s[2] * s[2] * s[3];
              const double swap_a = 0.09 * s[0] * s[2] * (s[2] - s[0]);
              const double swap_b = 0.09 * s[1] * s[3] * (s[3] - s[1]);
              return State{3 - 10 * s[0] + first + swap_a, 9 * s[0] - first + swap_b,
                           3 - 10 * s[2] + second - swap_a, 9 * s[2] - second - swap_b};
          },
          {1.85, 5.66, 50.6, 186}},
         {3, 3, 3, 3},
         {"a", "b", "c", "d"},
         0.001},
    };
}

/// The wavelength in cells of the wave that grows fastest, as `cascade analyze` computes it with
/// the library's values.
double analysed_wavelength(const std::string& system) {
    const Script script =
        load_script("test", fmt::format("stage only: {} {{ iterations: 1 }}", system), ".");
    EXPECT_TRUE(script.program) << script.messages(false);
    const auto analysis = analysis::analyze_stage(*script.program, 0);
    EXPECT_TRUE(analysis && !analysis->states.empty()) << system;
    return analysis::state_to_show(*analysis).relation.fastest.cells();
}

class TuringTest : public testing::TestWithParam<Case> {};

/// While a pattern from weak noise is small, its strongest wave is the one that grows fastest. On
/// the grid k² becomes (2 sin(k/2))².
TEST_P(TuringTest, WavelengthIsThatOfTheDispersionRelation) {
    const Case& each = GetParam();
    const State flat = flat_state(each.mathematics, each.guess);
    const double square = fastest_wave(each.mathematics, flat, 2);
    ASSERT_GT(growth_rate(each.mathematics, flat, square), 0);
    ASSERT_LT(growth_rate(each.mathematics, flat, 0), growth_rate(each.mathematics, flat, square));
    const double predicted = std::numbers::pi / std::asin(std::sqrt(square) / 2);
    EXPECT_NEAR(analysed_wavelength(each.system) / predicted, 1, 5e-3);

    std::string stage = fmt::format("speed: {}\n", each.speed);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        stage += fmt::format("{}: {} + random(0, {})\n", each.species[i], flat[i],
                             1e-3 * (0.1 + std::abs(flat[i])));
    }
    Model model(each.system, fmt::format("grid: {0}, {0}", turing_side), stage);
    const double start = model.deviation(each.species[0]);
    double grown = 0;
    for (int round = 0; round < 400 && grown < 20 * start; ++round) {
        model.step(200);
        grown = model.deviation(each.species[0]);
    }
    EXPECT_GT(grown, 20 * start) << "nothing has grown";

    measure::Samples samples;
    samples.cells = {turing_side, turing_side, 1};
    samples.values = model.values(each.species[0]);
    const double measured = measure::peak_wavelength(measure::radial_spectrum(samples));
    EXPECT_NEAR(measured / predicted, 1, each.tolerance) << "predicted " << predicted;
}

INSTANTIATE_TEST_SUITE_P(Library, TuringTest, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.system; });

/// Finds Turing's threshold of the Brusselator, B = (1 + A √(Du/Dv))², from the growth of the
/// critical wave a little above and below the threshold.
TEST(Turing, BrusselatorThreshold) {
    constexpr int cells = 64, mode = 6;
    constexpr double feed = 2, diff_u = 4;
    const double step = 2 * std::sin(std::numbers::pi * mode / cells);
    // Chosen so that kc² = A / √(Du Dv) is the k² of this wave.
    const double diff_v = feed * feed / (diff_u * step * step * step * step);
    const double ratio = 1 + feed * std::sqrt(diff_u / diff_v);
    const double threshold = ratio * ratio;
    std::vector<double> rates;
    for (const double part : {0.98, 1.02}) {
        const double decay = part * threshold;
        Model model("brusselator", "grid: 64",
                    fmt::format("speed: 0.004; feed: {}; decay: {}; diff_u: {}; diff_v: {}\n"
                                "u: {} + 0.02 * cos(12 * pi * x); v: {}",
                                feed, decay, diff_u, diff_v, feed, decay / feed));
        model.step(1250);
        const double early = wave_amplitude(model.values("u"), mode);
        model.step(1250);
        const double late = wave_amplitude(model.values("u"), mode);
        rates.push_back(std::log(late / early) / 5);
        const ReactionDiffusion mathematics{[&](const State& s) {
                                                return State{feed - (decay + 1) * s[0] +
                                                                 s[0] * s[0] * s[1],
                                                             decay * s[0] - s[0] * s[0] * s[1]};
                                            },
                                            {diff_u, diff_v}};
        const double predicted = growth_rate(mathematics, {feed, decay / feed}, step * step);
        EXPECT_NEAR(rates.back(), predicted, 0.05 * std::abs(predicted)) << part;
    }
    const double crossing = 0.98 + 0.04 * rates[0] / (rates[0] - rates[1]);
    EXPECT_NEAR(crossing, 1, 0.002);
}

}  // namespace
}  // namespace cascade::models
