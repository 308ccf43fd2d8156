// Scripts whose steps go through memory in tiles of time. They give the bits of plain steps with
// all solvers, on grids, in space, under masks and on models. Runs may be stopped or blow up within
// a tile.
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {
namespace {

/// A script with its simulation, how its steps go through memory, and its result.
struct TiledRun {
    Script script;
    std::unique_ptr<Simulation> simulation;
    std::string failure, stepping;
    std::int64_t steps = 0;
    StageEnd end = StageEnd::finished;
};

/// How a run takes its steps.
struct Way {
    std::string_view backend = "interp";
    int threads = 1;
    Tiling tiling;
};

std::string name_of(const Way& way) {
    return std::string(way.backend == "jit" ? "jit" : "interpreter") + ", " +
           std::to_string(way.threads) + " threads, " + std::to_string(way.tiling.levels) +
           " levels on layers of " + std::to_string(way.tiling.outer_layer) + ", " +
           std::to_string(way.tiling.inner_bands) + " bands";
}

/// Takes the steps of the only stage, and calls observe() after every `every` steps.
std::unique_ptr<TiledRun> run_in_tiles(const std::string& text, const Way& way, RunControl& control,
                                       const std::function<void()>& observe = {},
                                       std::int64_t every = 0) {
    auto ran = std::make_unique<TiledRun>();
    ran->script = load_script("test", text, ".");
    EXPECT_TRUE(ran->script.program) << text << ran->script.messages(false);
    if (!ran->script.program) return ran;
    TimeAccount account;
    SimulationOptions options;
    options.backend = way.backend;
    options.threads = way.threads;
    options.tiling = way.tiling;
    options.account = &account;
    auto made = Simulation::create(ran->script, options);
    EXPECT_TRUE(made) << text << (made ? "" : made.error().message) << ran->script.messages(false);
    if (!made) return ran;
    ran->simulation = std::move(*made);
    const auto started = ran->simulation->start_stage(0);
    EXPECT_TRUE(started) << text << (started ? "" : started.error().message);
    if (!started) return ran;
    auto end = ran->simulation->advance_stage(0, ran->script.program->stages[0].iterations, control,
                                              observe, every);
    if (end) {
        ran->end = *end;
    } else {
        ran->failure = end.error().message + " | " + end.error().hint;
    }
    ran->steps = ran->simulation->state(0).steps;
    ran->stepping = account.stage(0).stepping.in_words();
    return ran;
}

std::unique_ptr<TiledRun> run_in_tiles(const std::string& text, const Way& way) {
    RunControl control;
    return run_in_tiles(text, way, control);
}

/// The words of all cells of all species. All NaN have the same word.
std::vector<std::uint64_t> words_of(const TiledRun& ran) {
    std::vector<std::uint64_t> words;
    if (!ran.simulation) return words;
    for (const Field& field : ran.simulation->state(0).species()) {
        field.visit([&](const auto& plane) {
            for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
                for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                    const auto value = double{plane.row(row)[i]};
                    words.push_back(std::isnan(value) ? ~std::uint64_t{0}
                                                      : std::bit_cast<std::uint64_t>(value));
                }
            }
        });
    }
    return words;
}

/// Runs a script in tiles of several shapes, and expects the bits of plain steps. `is_tiled` says
/// whether one thread takes more than one sweep at once. With several threads, bands may be too
/// narrow for that.
void expect_same_bits(const std::string& text, std::optional<bool> is_tiled = true) {
    SCOPED_TRACE(text);
    for (const std::string& backend : available_backends()) {
        const auto plain = run_in_tiles(text, {backend, 1, {}});
        EXPECT_EQ(plain->failure, "");
        const std::vector<std::uint64_t> expected = words_of(*plain);
        ASSERT_FALSE(expected.empty());
        for (const int threads : {1, 3}) {
            for (const Tiling& tiling : {Tiling{7, 2}, Tiling{12, 1, 2, 3}}) {
                const Way way{backend, threads, tiling};
                SCOPED_TRACE(name_of(way));
                const auto tiled = run_in_tiles(text, way);
                EXPECT_EQ(tiled->failure, "");
                EXPECT_EQ(tiled->steps, plain->steps);
                if (threads == 1 && is_tiled) {
                    EXPECT_EQ(tiled->stepping.find("one step a pass") == std::string::npos,
                              *is_tiled)
                        << tiled->stepping;
                }
                EXPECT_TRUE(words_of(*tiled) == expected);
            }
        }
    }
}

// The grids of these tests are large enough for three threads to be used.

TEST(TiledRuns, EulerWithAFrozenDiscAndAParameterOfEachCell) {
    expect_same_bits(
        "domain { grid: 173, 149; boundary: periodic }\n"
        "stage s: turing_spots { iterations: 70; frozen: disc(0.3, 0.4, 0.2)\n"
        "  beta: random(12, 0.1) }\n");
}

TEST(TiledRuns, NoFluxAndDoublePrecision) {
    expect_same_bits(
        "domain { grid: 173, 149; boundary: noflux; precision: double }\n"
        "stage s: turing_spots { iterations: 20 }\n");
}

TEST(TiledRuns, Symplectic) {
    expect_same_bits(
        "domain { grid: 160, 170; boundary: noflux, periodic }\n"
        "system wave { u: disc(0.3, 0.3, 0.1); w: 0\n"
        "  u' = w\n  w' = 0.2 * lap(u) }\n"
        "stage s: wave { iterations: 70; speed: 0.5; solver: symplectic }\n");
}

TEST(TiledRuns, SolversOfSeveralSweeps) {
    for (const char* const solver :
         {"solver: rk4; iterations: 13; speed: 0.5", "solver: rkl1; duration: 30",
          "solver: rkl2; duration: 30", "solver: rkl2; iterations: 7; speed: 2"}) {
        expect_same_bits(
            "domain { grid: 173, 149; boundary: periodic }\n"
            "stage s: turing_spots { " +
            std::string(solver) + " }\n");
    }
}

TEST(TiledRuns, PassesOverTemporaries) {
    expect_same_bits(
        "domain { grid: 190, 173 }\n"
        "system mixing { c: random(0, 0.1); d: random(1, 0.1)\n"
        "  mu = c^3 - c - 0.5 * lap(c)\n"
        "  c' = lap(mu)\n  d' = lap(lap(d) * mu) + 0.1 * step * (c - d) }\n"
        "stage s: mixing { iterations: 40; speed: 0.002 }\n");
}

TEST(TiledRuns, SidesThatChangeWithTime) {
    for (const char* const solver : {"solver: euler", "solver: rk4"}) {
        expect_same_bits(
            "domain { grid: 173, 149; boundary: noflux }\n"
            "system tide { u[i]: 0; i: 1..2\n  u[i]' = lap(u[i]) - 0.1 * u[i]\n"
            "  u[i].left: fixed(sin(i * t) * sy); u[i].top: slope(cos(t) * sx)\n"
            "  u[i].bottom: fixed(t) }\n"
            "stage s: tide { iterations: 40; speed: 0.15; " +
            std::string(solver) + " }\n");
    }
}

TEST(TiledRuns, SidesThatReadSpecies) {
    for (const char* const solver :
         {"euler; iterations: 30", "rk4; iterations: 9", "rkl2; duration: 9"}) {
        for (const char* const grid : {"173, 149", "3000, 4", "40, 36, 29"}) {
            expect_same_bits(
                fmt::format(
                    "domain {{ grid: {}; boundary: noflux }}\n"
                    "system wall {{ c: 1 + sin(9 * x); w: y; k = c * w\n"
                    "  c' = 0.2 * lap(c) - 0.1 * c * w\n  w' = 0.1 * lap(w) + 0.01 * dx(c)\n"
                    "  c.left: flux(0.2 * (w - c)); w.left: flux(0.2 * (c - w)); c.right: fixed(w^2)\n"
                    "  c.top: slope(sin(t) - k); w.bottom: slope(c - sx * w); w.back: slope(-w) }}\n"
                    "stage s: wall {{ speed: 0.5; solver: {} }}\n",
                    grid, solver),
                std::nullopt);
        }
    }
}

TEST(TiledRuns, SidesThatWrapForOneSpeciesOnly) {
    expect_same_bits(
        "domain { grid: 173, 149; boundary: periodic }\n"
        "system pair { u: random(1, 0.5); v: random(1, 0.5)\n"
        "  u' = 0.5 * lap(u) - v * u\n  v' = 0.5 * lap(v) + dx(u) * dy(u)\n"
        "  u.top: fixed(1); u.bottom: fixed(0.5) }\n"
        "stage s: pair { iterations: 40; speed: 0.2 }\n");
}

TEST(TiledRuns, Masks) {
    expect_same_bits(
        "domain { grid: 190, 173; mask: disc(0.5, 0.5, 0.45) and not disc(0.4, 0.4, 0.1) }\n"
        "stage s: turing_spots { iterations: 40; frozen: x > 0.6 }\n");
}

TEST(TiledRuns, Families) {
    expect_same_bits(
        "domain { grid: 160, 120 }\n"
        "system ring { u[i]: random(1, 0.3); i: 1..4\n"
        "  u[i]' = 0.1 * i * lap(u[i]) + u[i] * (u[mod(i, 4) + 1] - u[i]) }\n"
        "stage s: ring { iterations: 40; speed: 0.2 }\n");
}

TEST(TiledRuns, OneDimension) {
    expect_same_bits("domain { grid: 3000, 1 }\nstage s: turing_spots { iterations: 70 }\n", false);
}

TEST(TiledRuns, InSpace) {
    for (const char* const boundary : {"periodic", "noflux"}) {
        expect_same_bits("domain { grid: 37, 41, 33; boundary: " + std::string(boundary) +
                         " }\n"
                         "stage s: turing_spots { iterations: 20; speed: 0.5 }\n");
    }
}

TEST(TiledRuns, OnAModel) {
    expect_same_bits(
        "domain { surface: sphere; cells: 13000 }\n"
        "stage s: turing_spots { iterations: 20 }\n");
}

TEST(TiledRuns, AggregatesEndTiles) {
    expect_same_bits(
        "domain { grid: 173, 149 }\n"
        "system s { u: 1 + random(0, 0.5); v: 1\n  q = lap(u) * u\n"
        "  u' = lap(q) * 0.1 - (u - mean(u over domain)); v' = 0.1 * lap(v * lap(q)) }\n"
        "stage s: s { iterations: 20; speed: 0.02 }\n",
        std::nullopt);
}

/// A script whose growing front overflows in the middle of a tile.
const char* const blow_up =
    "domain { grid: 173, 149 }\n"
    "system grow { u: 1 + 0.5 * disc(0.6, 0.3, 0.1) + random(0, 0.01)\n"
    "  u' = u^2 + 0.1 * lap(u) }\n"
    "stage s: grow { iterations: 500; speed: 0.02 }\n";

TEST(TiledRuns, BlowUpsAreFoundAtTheSameStepAndCell) {
    for (const std::string& backend : available_backends()) {
        const auto plain = run_in_tiles(blow_up, {backend, 1, {}});
        ASSERT_NE(plain->failure.find("step"), std::string::npos) << plain->failure;
        for (const int threads : {1, 3}) {
            const auto tiled = run_in_tiles(blow_up, {backend, threads, {11, 2}});
            EXPECT_EQ(tiled->failure, plain->failure);
            EXPECT_EQ(tiled->steps, plain->steps);
            EXPECT_TRUE(words_of(*tiled) == words_of(*plain));
        }
    }
}

// A run that is cancelled stops after some complete step, with the values that as many plain steps
// give.
TEST(TiledRuns, ACancelLeavesACompleteStep) {
    const auto text = [](std::int64_t steps) {
        return "domain { grid: 173, 149 }\nstage s: turing_spots { iterations: " +
               std::to_string(steps) + "; frozen: disc(0.3, 0.4, 0.2) }\n";
    };
    for (const int threads : {1, 3}) {
        RunControl control;
        int seen = 0;
        // The time loop reports at once, and then about ten times a second.
        control.report = [&](const Progress& progress) {
            if (progress.step > 0 && ++seen == 2) control.cancel = true;
        };
        const Way way{"interp", threads, {7, 2}};
        const auto stopped = run_in_tiles(text(1000000), way, control);
        EXPECT_EQ(stopped->end, StageEnd::cancelled);
        EXPECT_GT(stopped->steps, 0);
        ASSERT_LT(stopped->steps, 1000000);
        const auto plain = run_in_tiles(text(stopped->steps), {"interp", 1, {}});
        EXPECT_EQ(plain->steps, stopped->steps);
        EXPECT_TRUE(words_of(*stopped) == words_of(*plain));
    }
}

// Observers are called after the same complete steps as without tiles.
TEST(TiledRuns, ObserversSeeTheSameSteps) {
    const std::string text =
        "domain { grid: 173, 149 }\nstage s: turing_spots { iterations: 50 }\n";
    const auto seen = [&](const Tiling& tiling) {
        std::vector<std::vector<std::uint64_t>> frames;
        RunControl control;
        auto ran = std::make_unique<TiledRun>();
        ran->script = load_script("test", text, ".");
        SimulationOptions options;
        options.backend = "interp";
        options.threads = 3;
        options.tiling = tiling;
        auto made = Simulation::create(ran->script, options);
        EXPECT_TRUE(made);
        if (!made) return frames;
        ran->simulation = std::move(*made);
        EXPECT_TRUE(ran->simulation->start_stage(0));
        EXPECT_TRUE(ran->simulation->advance_stage(
            0, 50, control, [&] { frames.push_back(words_of(*ran)); }, 9));
        return frames;
    };
    const auto plain = seen({});
    EXPECT_EQ(plain.size(), 5u);
    EXPECT_TRUE(seen({7, 2}) == plain);
}

}  // namespace
}  // namespace cascade
