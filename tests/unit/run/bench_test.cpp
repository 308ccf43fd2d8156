// The work of a step, compared with counts by hand, and what limits the speed of steps.
#include "run/commands/bench.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/step_work.h"
#include "tests/unit/run/run_fixture.h"

#include <cmath>
#include <limits>

namespace cascade {
namespace {

class BenchTest : public RunTest {
protected:
    /// The work of a step of the first stage, counted after one step.
    StepWork work_of_text(const std::string& text) {
        Script script = load(text);
        EXPECT_TRUE(script.program) << script.messages(false);
        SimulationOptions options;
        options.backend = "interp";
        options.threads = 1;
        auto simulation = Simulation::create(script, options);
        EXPECT_TRUE(simulation);
        EXPECT_TRUE((*simulation)->start_stage(0));
        RunControl control;
        EXPECT_TRUE((*simulation)->advance_stage(0, 1, control, {}));
        return step_work(**simulation, 0);
    }
};

TEST_F(BenchTest, DiffusionOfOneSpecies) {
    const StepWork work = work_of_text(R"(
domain { grid: 32, 16 }
system heat { u: random(0.5, 0.5); d: 0.1; u' = d * lap(u) }
stage s: heat { iterations: 10; speed: 1 }
)");
    // N + S + E + W − 4 c takes five operations, the products with d and with the step's length one
    // each, and adding the result to u one more.
    EXPECT_EQ(work.cost.operations, 8);
    EXPECT_EQ(work.cost.loads, 5);
    EXPECT_EQ(work.cost.stores, 1);
    EXPECT_EQ(work.bytes, 8);
    EXPECT_EQ(work.working_set, 2 * 4 * 32 * 16);
    EXPECT_EQ(work.passes, 1u);
    EXPECT_FALSE(work.has_waves);
}

TEST_F(BenchTest, APlaneIsReadBesides) {
    const StepWork work = work_of_text(R"(
domain { grid: 32, 16; precision: double }
system heat { u: 1; d: random(0.5, 0.5); u' = d * lap(u) }
stage s: heat { iterations: 10; speed: 1 }
)");
    EXPECT_EQ(work.cost.loads, 6);
    EXPECT_EQ(work.bytes, 24);
    EXPECT_EQ(work.working_set, 3 * 8 * 32 * 16);
}

TEST_F(BenchTest, StagesOfASolverAddUp) {
    const char* const text = R"(
domain { grid: 32, 16 }
system heat { u: random(0.5, 0.5); d: 0.1; u' = d * lap(u) }
stage s: heat { iterations: 10; speed: 0.5; solver: rk4 }
)";
    const StepWork work = work_of_text(text);
    EXPECT_EQ(work.passes, 4u);
    EXPECT_GE(work.cost.operations, 4 * 6);
    EXPECT_GE(work.bytes, 4 * 8);
}

TEST_F(BenchTest, AllStagesAreMeasured) {
    Script script = load(two_stages);
    BenchRequest request;
    request.simulation.backend = "interp";
    request.simulation.threads = 1;
    request.seconds = 0.01;
    request.has_limits = false;
    RunControl control;
    std::vector<StageBench> stages;
    const auto done =
        bench(script, request, control, [&](const StageBench& stage) { stages.push_back(stage); });
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].stage, "large");
    EXPECT_EQ(stages[1].stage, "small");
    for (const StageBench& stage : stages) {
        EXPECT_EQ(stage.nothing, "");
        EXPECT_GT(stage.step, 0);
        EXPECT_GT(stage.steps, 0);
        EXPECT_GT(stage.work.cost.operations, 10);
        EXPECT_NEAR(stage.cell_steps_per_second() * stage.step, 24 * 18, 1e-6);
        EXPECT_EQ(stage.threads, 1);
        EXPECT_FALSE(stage.limits);
    }
    stages.clear();
    request.stage = "2";
    ASSERT_TRUE(
        bench(script, request, control, [&](const StageBench& stage) { stages.push_back(stage); }));
    ASSERT_EQ(stages.size(), 1u);
    EXPECT_EQ(stages[0].stage, "small");
    request.stage = "3";
    EXPECT_FALSE(bench(script, request, control, [](const StageBench&) {}));
}

TEST_F(BenchTest, CellsThatCrawlAreCountedWhileTheyGrow) {
    Script script = load(R"(
cells dot: covering, solid { r: 0.1 }
domain { grid: 16, 16; boundary: noflux }
stage s: dot { founders: 4; duration: 8 }
stage rest: dot { iterations: 50 }
)");
    BenchRequest request;
    request.simulation.backend = "interp";
    request.simulation.threads = 1;
    request.seconds = 0.02;
    RunControl control;
    std::vector<StageBench> stages;
    const auto done =
        bench(script, request, control, [&](const StageBench& stage) { stages.push_back(stage); });
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_EQ(stages.size(), 2u);
    for (const StageBench& stage : stages) {
        EXPECT_EQ(stage.nothing, "");
        EXPECT_TRUE(stage.is_of_cells());
        EXPECT_GT(stage.cells(), 4);
        EXPECT_GT(stage.steps, 0);
        EXPECT_NEAR(stage.cell_steps_per_second() * stage.step, stage.mean_cells, 1e-6);
        EXPECT_FALSE(stage.limits);
    }
}

TEST_F(BenchTest, ACancelEndsItWithoutATable) {
    Script script = load(two_stages);
    BenchRequest request;
    request.simulation.backend = "interp";
    request.seconds = 1000;
    RunControl control;
    control.cancel = true;
    int told = 0;
    EXPECT_TRUE(bench(script, request, control, [&](const StageBench&) { ++told; }));
    EXPECT_EQ(told, 0);
}

/// Steps of a hundred cells with known work, on a machine with known limits.
StageBench known_bench() {
    StageBench bench;
    bench.grid = {10, 10};
    bench.step = 1e-6;
    bench.work.cost.operations = 10;
    bench.work.cost.load_bytes = 16;
    bench.work.cost.store_bytes = 4;
    bench.work.bytes = 8;
    bench.work.working_set = 5000;
    bench.stepping.meetings = 2;
    MachineLimits limits;
    limits.operations = 4e9;
    limits.divisions = 1e9;
    limits.memories = {{"first-level cache", 1000, 1e10},
                       {"second-level cache", 10000, 4e9},
                       {"memory", std::numeric_limits<double>::infinity(), 1e9}};
    bench.limits = limits;
    return bench;
}

TEST(Bounds, TheLargestShareBounds) {
    StageBench bench = known_bench();
    // At 1e8 cell-steps a second the stage uses 1e9 of 4e9 operations, 2e9 of 1e10 bytes of the
    // first-level cache, and 8e8 of 4e9 bytes of the second-level cache.
    auto bounds = bounds_of(bench);
    ASSERT_EQ(bounds.size(), 3u);
    EXPECT_NEAR(bounds[0].share(), 0.25, 1e-12);
    EXPECT_NEAR(bounds[1].share(), 0.2, 1e-12);
    EXPECT_NEAR(bounds[2].share(), 0.2, 1e-12);
    EXPECT_EQ(tightest(bounds).kind, Bound::Kind::operations);
    EXPECT_NEAR(attainable(bench)->cell_steps_per_second, 4e8, 1);
    EXPECT_EQ(attainable(bench)->name, "arithmetic");
    bench.work.working_set = 1e6;
    EXPECT_EQ(tightest(bounds_of(bench)).kind, Bound::Kind::home);
    EXPECT_NEAR(attainable(bench)->cell_steps_per_second, 1.25e8, 1);
    EXPECT_EQ(attainable(bench)->name, "memory");
    // At this speed memory would carry more than it can, so it cannot be what bounds the stage.
    bench.step = 1e-7;
    EXPECT_NE(tightest(bounds_of(bench)).kind, Bound::Kind::home);
}

TEST(Bounds, TilesShareTheBytesOfMemoryAndAreFedByACache) {
    StageBench bench = known_bench();
    bench.work.working_set = 1e6;
    bench.threads = 2;
    bench.stepping.sweeps_at_once = 16;
    bench.stepping.bytes_in_use = 4000;  // For each of two threads: 8000 bytes are in use.
    const auto bounds = bounds_of(bench);
    ASSERT_EQ(bounds.size(), 4u);
    EXPECT_EQ(bounds[2].name, "tiles, second-level cache");
    EXPECT_NEAR(bounds[2].share(), 0.2, 1e-12);
    EXPECT_EQ(bounds[3].name, "planes, memory");
    EXPECT_NEAR(bounds[3].share(), 0.8 / 16, 1e-12);
    // A cell-step takes half a byte of the 1e9 that memory gives in a second, 8 bytes of the
    // cache's 4e9, and 10 of 4e9 operations.
    EXPECT_NEAR(attainable(bench)->cell_steps_per_second, 4e8, 1);
    bench.work.bytes = 80;
    EXPECT_NEAR(attainable(bench)->cell_steps_per_second, 5e7, 1);
    EXPECT_EQ(attainable(bench)->name, "second-level cache");
    // Fits into the first-level cache, whose limit is the limit of loads and stores.
    bench.stepping.bytes_in_use = 400;
    EXPECT_EQ(bounds_of(bench).size(), 3u);
}

TEST(Bounds, ThreadsThatMeetTooOften) {
    StageBench bench = known_bench();
    bench.threads = 2;
    bench.limits->meeting = 4e-7;
    const auto bounds = bounds_of(bench);
    EXPECT_EQ(tightest(bounds).kind, Bound::Kind::meetings);
    EXPECT_NEAR(tightest(bounds).share(), 0.8, 1e-12);
    bench.limits.reset();
    EXPECT_TRUE(bounds_of(bench).empty());
    EXPECT_FALSE(attainable(bench));
}

}  // namespace
}  // namespace cascade
