// Stages that start on coarser grids: as good a pattern as of a fine run, what each grid starts
// with, and where a run may be stopped.
#include "resumed_run.h"

#include "measure/spectrum.h"
#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace cascade {
namespace {

using ::testing::HasSubstr;

struct Ran {
    Script script;
    std::unique_ptr<Simulation> simulation;
    std::string failure;
    std::vector<std::string> reported;
};

Ran run_text(const std::string& text,
             SimulationOptions options = {BackendKind::interpreter, 0, 1}) {
    Ran ran;
    ran.script = load_script("test", text, ".", {});
    EXPECT_TRUE(ran.script.program) << ran.script.messages(false);
    if (!ran.script.program) return ran;
    auto made = Simulation::create(ran.script, options);
    EXPECT_TRUE(made);
    ran.simulation = std::move(*made);
    RunControl control;
    control.report = [&](const Progress& progress) {
        if (progress.stage_done) {
            ran.reported.push_back(
                fmt::format("{}: {}", progress.stage + progress.note, progress.step));
        }
    };
    for (std::uint32_t k = 0; k < ran.script.stage_count() && ran.failure.empty(); ++k) {
        EXPECT_TRUE(ran.simulation->start_stage(k));
        const std::int64_t most = ran.script.program->stages[k].iterations;
        auto end = ran.simulation->advance_stage(k, most, control, {});
        if (!end) ran.failure = end.error().message;
    }
    return ran;
}

double wavelength(const Field& field) {
    const PlaneLayout& layout = field.layout();
    measure::Samples samples;
    samples.cells = {static_cast<std::size_t>(layout.width),
                     static_cast<std::size_t>(layout.height), 1};
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            samples.values.push_back(static_cast<double>(field.at(i, j)));
        }
    }
    return measure::peak_wavelength(measure::radial_spectrum(samples));
}

TEST(CoarseStart, GrowsAsGoodAPattern) {
    SimulationOptions options;
    options.threads = 1;
    if (!has_jit()) options.backend = BackendKind::interpreter;
    const auto spots = [&](const std::string& settings) {
        return run_text("stage s: turing_spots { ka: 0.05/16; " + settings +
                            " }\ndomain { grid: 96, 96 }",
                        options);
    };
    const Ran fine = spots("iterations: 28000");
    const Ran coarse = spots("iterations: 1750; start: coarse(4)");
    const Field& expected = fine.simulation->state(0).species[1];
    const Field& found = coarse.simulation->state(0).species[1];
    EXPECT_NEAR(wavelength(found) / wavelength(expected), 1, 0.08);
    EXPECT_NEAR(moments(found).mean / moments(expected).mean, 1, 0.03);
    EXPECT_NEAR(moments(found).deviation / moments(expected).deviation, 1, 0.08);
    EXPECT_EQ(coarse.reported,
              (std::vector<std::string>{"s, cells 4 times as wide: 28000",
                                        "s, cells 2 times as wide: 7000", "s: 1750"}));
}

// What diffuses alone is the same on all grids: the straight line between two sides.
TEST(CoarseStart, SidesAndLengthsStayTheSame) {
    const Ran ran = run_text(
        "system heat { u: 0; u' = lap(u); u.left: fixed(1); u.right: flux(1/8) }\n"
        "stage s: heat { start: coarse(4); iterations: 400; speed: 0.4 }\n"
        "domain { grid: 32, 1; boundary: noflux; spacing: 1 }");
    const Field& u = ran.simulation->state(0).species[0];
    for (std::int64_t i = 0; i < 32; ++i) {
        EXPECT_NEAR(u.at(i, 0), 1 + (static_cast<double>(i) + 0.5) / 8, 5e-3);
    }
    const Ran longer = run_text(
        "system heat { u: 0; u' = lap(u); u.left: fixed(1); u.right: flux(1/8) }\n"
        "stage s: heat { solver: imex; start: coarse(8); duration: 200; speed: 5 }\n"
        "domain { grid: 32, 1; boundary: noflux; spacing: 1 }");
    for (std::int64_t i = 0; i < 32; ++i) {
        EXPECT_NEAR(longer.simulation->state(0).species[0].at(i, 0),
                    1 + (static_cast<double>(i) + 0.5) / 8, 2e-3);
    }
}

TEST(CoarseStart, ReadsEarlierStagesAndKeepsFrozenCells) {
    const Ran ran = run_text(
        "system still { u: x; k: 1; u' = k * 0 }\n"
        "system grow { u: 0; base: 0; u' = base }\n"
        "stage first: still { iterations: 1 }\n"
        "stage second: grow { start: coarse(2); iterations: 2; frozen: x > 0.7; base: first.u; u: "
        "5 * x }\n"
        "domain { grid: 16, 8 }");
    const Field& u = ran.simulation->state(1).species[0];
    const auto x = [](std::int64_t i) { return (static_cast<float>(i) + 0.5f) / 16; };
    // Eight steps on the coarse grid and two here, of what is linear in x but for the periodic
    // sides.
    EXPECT_NEAR(u.at(6, 3), 5 * x(6) + 10 * x(6), 1e-5);
    EXPECT_EQ(u.at(14, 3), 5 * x(14));
}

TEST(CoarseStart, SameBitsOnEveryBackendAndThread) {
    if (!has_jit()) GTEST_SKIP() << "no native code in this build";
    const std::string text =
        "stage s: turing_spots { start: coarse(4); iterations: 20; ka: 1/80; frozen: x > 0.9 }\n"
        "domain { grid: 96, 64; boundary: noflux }";
    const Ran expected = run_text(text);
    const Ran found = run_text(text, {BackendKind::jit, 16, 3});
    EXPECT_EQ(moments_of_difference(found.simulation->state(0).species[1],
                                    expected.simulation->state(0).species[1])
                  .root_mean_square,
              0);
}

TEST(CoarseStart, ABlowUpSaysOnWhichGrid) {
    const Ran ran = run_text(
        "system burst { u: 1; u' = u^2 }\nstage s: burst { start: coarse(2); iterations: 300 }\n"
        "domain { grid: 8, 8 }");
    EXPECT_THAT(ran.failure, HasSubstr("(on the grid with cells 2 times as wide)"));
}

TEST(CoarseStart, ThreeDimensions) {
    const Ran ran = run_text(
        "system decay { u: 1 + x + y + z; u' = -u }\n"
        "stage s: decay { start: coarse(2); iterations: 4; speed: 0.01 }\n"
        "domain { grid: 8, 8, 8; boundary: noflux }");
    const float x = 3.5f / 8;
    EXPECT_NEAR(ran.simulation->state(0).species[0].at(3, 3, 3), (1 + 3 * x) * std::pow(0.99, 20),
                1e-5);
}

class CoarseStartRun : public ResumedRunTest {};

TEST_F(CoarseStartRun, ResumesWithTheSameBits) {
    const std::string text =
        "stage one: turing_spots { start: coarse(2); iterations: 30; ka: 1/80 }\n"
        "domain { grid: 32, 24 }";
    run_whole(text);
    for (const std::int64_t stop : {0, 7}) {
        run_in_two_parts(text, "one", stop);
        EXPECT_EQ(bytes("whole/one.b.npy"), bytes("rest/one.b.npy")) << stop;
    }
}

}  // namespace
}  // namespace cascade
