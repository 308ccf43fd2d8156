// `until: steady(e)` on real systems: the table of spec/time.md, on the planes that are quick.
#include "resumed_run.h"

#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>

namespace cascade {
namespace {

/// Where a stage came to rest.
struct Rest {
    std::int64_t steps = 0;
    double t = 0;
    double contrast = 0;  ///< Deviation of the last species over the cells.
};

/// Runs all stages; tells of each.
std::vector<Rest> rests_of(const std::string& text, std::int64_t side,
                           const std::string& solver = "") {
    Overrides changes;
    changes.grid = GridSize{side, side};
    if (!solver.empty()) changes.solver = solver;
    Script script = load_script("test", text, ".", changes);
    EXPECT_TRUE(script.program) << script.messages(false);
    SimulationOptions options;
    options.threads = 1;
    if (!has_jit()) options.backend = BackendKind::interpreter;
    auto simulation = std::move(*Simulation::create(script, options));
    RunControl control;
    std::vector<Rest> rests;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        EXPECT_TRUE(simulation->start_stage(k));
        const std::int64_t most = script.program->stages[k].iterations;
        const auto end = simulation->advance_stage(k, most, control, {});
        EXPECT_TRUE(end) << (end ? "" : end.error().message);
        const StageState& state = simulation->state(k);
        rests.push_back({state.steps, state.t, moments(state.species.back()).deviation});
    }
    return rests;
}

constexpr const char* small_spots = "stage s: turing_spots { until: steady(0.2); ka: 0.2/16 }\n";

TEST(Settled, SpotsAreThereAtTheSameTimeOnEveryPlane) {
    for (const std::int64_t side : {48, 64, 128}) {
        if (side > 64 && !has_jit()) continue;  // Minutes.
        const Rest rest = rests_of(small_spots, side)[0];
        EXPECT_GT(rest.t, 2500) << side;
        EXPECT_LT(rest.t, 4500) << side;
        EXPECT_GT(rest.contrast, 1.5) << side;  // 1.75 when nothing moves any more.
    }
}

TEST(Settled, HardlyDependsOnTheSeedNorOnTheLooks) {
    for (const char* settings : {"check: 20", "check: 300", "iterations: 100000"}) {
        for (int seed = 2; seed < (has_jit() ? 5 : 3); ++seed) {
            const std::string text = fmt::format(
                "domain {{ grid: 64, 64; seed: {} }}\n"
                "stage s: turing_spots {{ until: steady(0.2); ka: 0.2/16; {} }}\n",
                seed, settings);
            const Rest rest = rests_of(text, 64)[0];
            EXPECT_GT(rest.t, 2300) << settings << ' ' << seed;
            EXPECT_LT(rest.t, 5000) << settings << ' ' << seed;
            EXPECT_GT(rest.contrast, 1.5) << settings << ' ' << seed;
        }
    }
}

TEST(Settled, HardlyDependsOnTheSolver) {
    const double euler = rests_of(small_spots, 64)[0].t;
    for (const char* solver : {"rkl1", "rkl2", "rk2", "rk23"}) {
        const Rest rest = rests_of(small_spots, 64, solver)[0];
        EXPECT_NEAR(rest.t, euler, 0.3 * euler) << solver;
        EXPECT_GT(rest.contrast, 1.5) << solver;
    }
}

TEST(Settled, ACascadeWaitsForEachOfItsStages) {
    if (!has_jit()) GTEST_SKIP() << "minutes without native code";
    const std::string leopard =
        "stage large: turing_spots { until: steady(0.2); ka: 0.05/16 }\n"
        "stage small: turing_spots {\n until: steady(0.2)\n frozen: b < 4\n a: if([frozen], 4, a)\n"
        " b: if([frozen], 4, b)\n beta: beta\n ka: 0.2/16\n}\n";
    const std::vector<Rest> rests = rests_of(leopard, 64);
    EXPECT_GT(rests[0].t, 12000);
    EXPECT_LT(rests[0].t, 22000);
    EXPECT_GT(rests[1].t, 2000);  // Small spots need that long between large ones.
    EXPECT_LT(rests[1].t, 6500);
}

TEST(Settled, AFrontOfCoralIsWaitedForUntilThePlaneIsFull) {
    const std::string coral =
        "stage s: gray_scott { until: steady(0.2); iterations: 40000\n"
        " u: 1 - 0.5 * disc(0.5, 0.5, 0.1)\n v: 0.25 * disc(0.5, 0.5, 0.1) + random(0.01, 0.01)\n"
        " feed: 0.037; kill: 0.060 }\n";
    const Rest small = rests_of(coral, 64)[0];
    EXPECT_GT(small.t, 1400);
    EXPECT_LT(small.t, 4000);
    if (!has_jit()) return;
    const Rest large = rests_of(coral, 128)[0];
    EXPECT_GT(large.t, 1.3 * small.t);  // The front has twice as far to go.
}

TEST(Settled, CoarseningAndWavesAreEndedByTheirIterations) {
    const std::string mixing =
        "system mixing { c: random(0, 0.1); c' = lap(c^3 - c - 0.5 * lap(c)); speed: 0.02 }\n"
        "stage s: mixing { until: steady(0.2); iterations: 5000 }\n";
    EXPECT_EQ(rests_of(mixing, 64)[0].steps, 5000);
    const std::string waves =
        "system waves { u: if(x < 0.5, 1, -1); v: if(y < 0.5, -0.3, 0.3); speed: 0.1\n"
        " u' = lap(u) + u - u^3 - v\n v' = 0.05 * (u - 0.5 * v) }\n"
        "stage s: waves { until: steady(0.5); iterations: 10000 }\n";
    EXPECT_EQ(rests_of(waves, 64)[0].steps, 10000);
}

TEST(Settled, ASteadyStartIsRecognisedAtOnce) {
    const std::string flat = "stage s: turing_spots { until: steady(0.1); beta: 12 }\n";
    EXPECT_EQ(rests_of(flat, 32)[0].steps, 100);
}

class SettledRun : public ResumedRunTest {};

TEST_F(SettledRun, ResumesBetweenTwoLooksWithTheSameEnd) {
    const std::string text =
        "domain { grid: 32, 32 }\nstage s: turing_spots { until: steady(0.2); ka: 0.2/16 }\n";
    run_whole(text);
    for (const std::int64_t stop : {50, 1250}) {
        run_in_two_parts(text, "s", stop);
        EXPECT_EQ(bytes("whole/s.b.npy"), bytes("rest/s.b.npy")) << stop;
        EXPECT_EQ(bytes("whole/run.json"), bytes("rest/run.json")) << stop;
    }
}

TEST_F(SettledRun, ASavedLookThatLacksSomethingIsRefused) {
    Script script = load("domain { grid: 16, 16 }\nstage s: turing_spots { until: steady(0.2) }\n");
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"s", 150};
    run_well(script, wanted);
    const auto saved = nlohmann::json::parse(bytes("saved/run.json"));
    const auto resume_with = [&](const auto& change) {
        nlohmann::json manifest = saved;
        change(manifest["stages"][0]["time"]["formations"]);
        EXPECT_TRUE(write_file(path("saved/run.json"), manifest.dump()));
        auto again = load_saved_script(path("saved"), {});
        EXPECT_TRUE(again);
        RunRequest rest = request();
        rest.resume = path("saved");
        return run_badly(*again, rest);
    };
    EXPECT_THAT(resume_with([](auto& formations) { formations.erase(0); }),
                ::testing::HasSubstr("it lacks how a species has formed"));
    EXPECT_THAT(resume_with([](auto& formations) { formations[1]["speed"] = -1; }),
                ::testing::HasSubstr("its time makes no sense"));
    EXPECT_THAT(resume_with([](auto& formations) { formations[1].erase("risen"); }),
                ::testing::HasSubstr("is damaged"));
}

}  // namespace
}  // namespace cascade
