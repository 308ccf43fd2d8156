// Whole scripts give the same bits whether they are interpreted or compiled, on one thread or
// several, and on whole grids or grids in parts.

#include "random_scripts.h"
#include "script_outcome.h"

#include "core/file.h"
#include "core/parallel.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"
#include "lang/library/library.h"
#include "lang/lower/lower.h"
#include "run/domain/input_files.h"
#include "run/simulation/simulation.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/plan_runner.h"
#include "support/kernel_comparison.h"
#include "support/new_seed.h"
#include "support/random_kernels.h"
#include "support/small_models.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#if CASCADE_HAS_JIT

namespace cascade {
namespace {

using test::expect_same;
using test::OperationCounts;
using test::Outcome;
using test::random_script;
using test::run_script;
using test::same_bits;

SimulationOptions interpreted() { return {"interp", 0, 1}; }
SimulationOptions compiled(int lanes, int threads) { return {"jit", lanes, threads}; }
SimulationOptions compiled_in_parts(int lanes, int parts) {
    // If the number of parts is odd, parts may be as thin as their halos.
    return {"jit", lanes, 1, in_parts(parts, parts % 2 == 1 ? 1 : least_thickness)};
}

/// A configuration: 2, 3 or 5 parts if `number` is odd, else 1, 2 or 3 threads.
SimulationOptions compiled_some_way(std::uint64_t number) {
    constexpr std::array<int, 3> parts{2, 3, 5};
    const int lanes = 4 << (number % 3), some = static_cast<int>(number / 2 % 3);
    return number % 2 == 0 ? compiled(lanes, 1 + some)
                           : compiled_in_parts(lanes, parts[static_cast<std::size_t>(some)]);
}

void compare_random_scripts(Precision precision, int scripts) {
    OperationCounts counts;
    int failed = 0;
    Overrides overrides;
    overrides.precision = precision;
    for (int seed = 0; seed < scripts; ++seed) {
        const std::string text = random_script(static_cast<std::uint64_t>(seed));
        overrides.fast = seed % 4 == 3;
        const Outcome expected = run_script("random", text, overrides, interpreted());
        const SimulationOptions options = compiled_some_way(static_cast<std::uint64_t>(seed));
        expect_same(expected, run_script("random", text, overrides, options), text);
        failed += expected.failure.empty() ? 0 : 1;
        if (::testing::Test::HasFailure()) return;

        Script script = load_script("random", text, ".", overrides);
        for (std::uint32_t k = 0; k < script.program->stages.size(); ++k) {
            for (const Pass& pass : plan_step(*script.program, k).passes) {
                EXPECT_EQ(verify(*pass.bound.kernel), "") << text;
                counts.add(*pass.bound.kernel);
            }
        }
    }
    // Most scripts must run to their end, otherwise little would be compared.
    EXPECT_LT(failed, scripts * 7 / 10);
    std::printf("%s%d of %d scripts ended in values that are not finite\n", counts.report().c_str(),
                failed, scripts);
    EXPECT_EQ(counts.missing(), "");
}

TEST(Agreement, RandomScripts) { compare_random_scripts(Precision::single, 1000); }
TEST(Agreement, RandomScriptsInDouble) { compare_random_scripts(Precision::binary64, 250); }

/// Scripts from new seeds give the same bits whether they are interpreted or compiled, in tiles of
/// several steps or step by step.
TEST(Agreement, NewRandomScripts) {
    constexpr std::uint64_t scripts = 500;
    constexpr std::array<Tiling, 4> tilings = {Tiling{}, Tiling{7, 2}, Tiling{3, 1},
                                               Tiling{12, 1, 2, 3}};
    Overrides overrides;
    for (std::uint64_t k = 0; k < scripts; ++k) {
        const std::uint64_t seed = test::new_seed() + k;
        SCOPED_TRACE(fmt::format("CASCADE_TEST_SEED={}", seed));
        const std::string text = random_script(seed);
        overrides.precision = k % 4 == 1 ? Precision::binary64 : Precision::single;
        overrides.fast = k % 4 == 3;
        SimulationOptions options = interpreted();
        options.tiling = tilings[k % tilings.size()];
        const Outcome expected = run_script("random", text, overrides, options);
        options = compiled(4 << (k % 3), static_cast<int>(1 + k % 3));
        options.tiling = tilings[(k + 1 + k / tilings.size() % 3) % tilings.size()];
        expect_same(expected, run_script("random", text, overrides, options), text);
        if (::testing::Test::HasFailure()) return;
    }
}

/// The bits are the same whether operands at neighbours are computed again or read from a plane.
TEST(Agreement, HoweverOperandsComeToNeighbours) {
    Team team(2);
    const InputFiles no_files;
    int passes_differ = 0;
    for (int seed = 0; seed < 400; ++seed) {
        const std::string text = random_script(static_cast<std::uint64_t>(seed));
        Script script = load_script("random", text, ".");
        ASSERT_TRUE(script.program) << text;
        auto simulation = Simulation::create(script, interpreted()).value();
        if (!simulation->start_stage(0)) continue;
        const Grid& grid = simulation->domain().grid;
        const auto backend = make_interpreter();
        const auto compile = [&](const CellKernel& kernel) {
            return *backend->compile(kernel, grid.stencil());
        };
        const BindingContext context{{&simulation->state(0), 1},
                                     no_files,
                                     3,
                                     grid,
                                     Precision::single,
                                     0,
                                     {},
                                     simulation->domain().shared_model().get(),
                                     simulation->domain().inside()};
        std::vector<std::vector<Field>> found;
        std::size_t passes = 0;
        for (const Materialise materialise :
             {Materialise::when_cheaper, Materialise::never, Materialise::always}) {
            const StepPlan plan = plan_rates(*script.program, 0, {materialise});
            passes_differ +=
                materialise == Materialise::always && plan.passes.size() != passes ? 1 : 0;
            passes = plan.passes.size();
            found.push_back(run_plan(plan, compile, context, grid, team));
            EXPECT_EQ(same_bits(found[0], found.back()), "") << text;
        }
        if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(passes_differ, 50);
}

/// The bits are the same whether step-invariants are computed in each step or once.
TEST(Agreement, HoweverStepsArePlanned) {
    std::size_t kept = 0;
    for (int seed = 0; seed < 500; ++seed) {
        const std::string text = random_script(static_cast<std::uint64_t>(seed));
        SimulationOptions options = interpreted();
        options.planning = {Materialise::always, false, false};
        const Outcome expected = run_script("random", text, {}, options);
        options.planning = {Materialise::never, false, true};
        expect_same(expected, run_script("random", text, {}, options), text);
        options.planning = {Materialise::when_cheaper, false, true};
        expect_same(expected, run_script("random", text, {}, options), text);
        if (::testing::Test::HasFailure()) return;
        const Script script = load_script("random", text, ".");
        for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
            kept +=
                plan_step_invariants(*script.program, k, options.planning).result_count > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(kept, 100u);
}

/// With `--fast`, all plans of a step give the same bits: step-invariants may be computed once, as
/// in runs, or in each step, as in compiled stages, and any operands may be in planes.
TEST(Agreement, HoweverFastStepsArePlanned) {
    Overrides overrides;
    overrides.fast = true;
    for (int seed = 0; seed < 500; ++seed) {
        const std::string text = random_script(static_cast<std::uint64_t>(seed));
        SimulationOptions options = interpreted();
        options.planning = {Materialise::when_cheaper, false, true};
        const Outcome expected = run_script("random", text, overrides, options);
        for (const Materialise materialise :
             {Materialise::when_cheaper, Materialise::never, Materialise::always}) {
            options.planning = {materialise, false, false};
            expect_same(expected, run_script("random", text, overrides, options),
                        std::to_string(seed) + ": " + text);
        }
        if (::testing::Test::HasFailure()) return;
    }
}

// The Laplacian reads a plane only if x is computed once. Products by 6 are rounded, so fusing them
// would change bits.
TEST(Agreement, FastLaplaciansInSpaceAreThoseOfPlanes) {
    Overrides overrides;
    overrides.fast = true;
    const std::string text =
        R"(domain { grid: 31, 7, 5; boundary: periodic; spacing: 0.75; seed: 606 }
fn f0(a) = ((dxy((x * 0 + 0))) + (dxz((x * a + pi))))
system s0 {
  p0: dzz((x * 0 + random(div(grad((x * 1e30 + z))), 7.75)))
  u0: z
  u0' = ((lap((x * t + sz))) != (f0(p0)))
}
stage g0: s0 { iterations: 5; speed: 0.125
})";
    SimulationOptions options = interpreted();
    options.planning = {Materialise::when_cheaper, false, true};
    const Outcome expected = run_script("sixfold", text, overrides, options);
    options.planning = {Materialise::when_cheaper, false, false};
    expect_same(expected, run_script("sixfold", text, overrides, options), text);
}

/// Runs random scripts in domains that grow, equally along all axes or not.
TEST(Agreement, RandomScriptsInGrowingDomains) {
    int scripts = 0, failed = 0;
    for (std::uint64_t seed = 0; seed < 20000 && scripts < 40; ++seed) {
        std::string text = random_script(seed);
        const std::size_t spacing = text.find("spacing: "), end = text.find(';', spacing);
        const Script plain = load_script("random", text, ".");
        if (!plain.program) continue;
        const Grid& grid = plain.program->domain.grid;
        const auto side = [&](std::int64_t cells) {
            return static_cast<double>(cells) * grid.spacing;
        };
        std::string extent = fmt::format("extent: {} * (1 + t / 3)", side(grid.width));
        if (seed % 2 == 1) extent += fmt::format(", {} * exp(t / 5)", side(grid.height));
        if (seed % 2 == 1 && grid.depth > 1) extent += fmt::format(", {}", side(grid.depth));
        text.replace(spacing, end - spacing, extent);
        Overrides overrides;
        overrides.precision = seed % 3 == 0 ? Precision::binary64 : Precision::single;
        // Scripts whose domain cannot grow are refused. Of the others, only scripts that read
        // neighbours are run.
        if (!load_script("random", text, ".", overrides).program) continue;
        const bool reads_neighbours =
            text.find("lap(") != text.npos || text.find("grad") != text.npos;
        if (!reads_neighbours) continue;
        overrides.fast = ++scripts % 4 == 3;
        const Outcome expected = run_script("random", text, overrides, interpreted());
        const SimulationOptions options = compiled_some_way(static_cast<std::uint64_t>(scripts));
        expect_same(expected, run_script("random", text, overrides, options), text);
        failed += expected.failure.empty() ? 0 : 1;
        if (::testing::Test::HasFailure()) break;
    }
    EXPECT_EQ(scripts, 40);
    EXPECT_LT(failed, 28);
}

std::filesystem::path small_torus() {
    const auto path =
        std::filesystem::path(::testing::TempDir()) / fmt::format("small_torus_{}.obj", getpid());
    EXPECT_TRUE(write_file(path, test::small_torus_obj()));
    return path;
}

TEST(Agreement, RandomScriptsOnModels) {
    static constexpr std::array<const char*, 5> domains = {"cells: 530", "cells: faces",
                                                           "cells: 37; unit: 0.1",
                                                           "cells: 1030; laplacian: turk",
                                                           "cells: vertices"};
    Overrides overrides;
    overrides.model = small_torus().string();
    overrides.model_is_asked_for = true;
    int scripts = 0, failed = 0;
    for (std::uint64_t seed = 0; seed < 20000 && scripts < 100; ++seed) {
        std::string text = random_script(seed);
        text.replace(0, text.find('\n'),
                     fmt::format("domain {{ surface: sphere; {}; seed: {} }}",
                                 domains[seed % domains.size()], seed));
        overrides.precision = seed % 3 == 0 ? Precision::binary64 : Precision::single;
        // Scripts that have no meaning on models are refused. Of the others, only scripts that read
        // neighbours are run.
        if (!load_script("random", text, ".", overrides).program) continue;
        const bool reads_neighbours =
            text.find("lap(") != text.npos || text.find("grad") != text.npos;
        if (!reads_neighbours) continue;
        overrides.fast = ++scripts % 4 == 3;
        const Outcome expected = run_script("random", text, overrides, interpreted());
        const SimulationOptions options = compiled_some_way(static_cast<std::uint64_t>(scripts));
        expect_same(expected, run_script("random", text, overrides, options), text);
        failed += expected.failure.empty() ? 0 : 1;
        if (::testing::Test::HasFailure()) break;
    }
    std::filesystem::remove(*overrides.model);
    EXPECT_EQ(scripts, 100);
    EXPECT_LT(failed, 70);
}

std::vector<std::filesystem::path> examples() {
    std::vector<std::filesystem::path> paths;
    const auto folder = std::filesystem::path(CASCADE_SOURCE_DIR) / "examples";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".cascade") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

TEST(Agreement, EverySystemOfTheLibraryInParts) {
    int in_space = 0;
    for (const LibraryText& each : library_texts()) {
        Overrides overrides;
        overrides.steps = 12;
        for (const GridSize& size : {GridSize{36, 29, 1}, GridSize{12, 11, 7}}) {
            overrides.grid = size;
            const std::string text(each.text), name(each.system_name());
            const bool fits = load_script(name, text, ".", overrides).program != nullptr;
            EXPECT_TRUE(fits || size.depth > 1) << name;
            if (!fits) continue;
            in_space += size.depth > 1 ? 1 : 0;
            const Outcome expected = run_script(name, text, overrides, interpreted());
            SimulationOptions options = interpreted();
            options.executor = in_parts(in_space % 2 == 0 ? 5 : 3, 1);
            expect_same(expected, run_script(name, text, overrides, options), name);
        }
    }
    EXPECT_GT(in_space, 30);
}

TEST(Agreement, EveryExampleOnLanesThreadsAndParts) {
    ASSERT_GE(examples().size(), 25u);
    for (const auto& path : examples()) {
        const std::string text = read_file(path, 1u << 20).value();
        Overrides few_steps;
        few_steps.steps = 200;
        const std::string name = path.filename().string();
        const Outcome expected = run_script(name, text, few_steps, interpreted());
        EXPECT_EQ(expected.failure, "") << name;
        EXPECT_FALSE(expected.fields.empty());
        for (const SimulationOptions& options :
             {compiled(4, 1), compiled(8, 3), compiled_in_parts(16, 5), compiled(16, 8)}) {
            expect_same(expected, run_script(name, text, few_steps, options),
                        name + ", lanes " + std::to_string(options.lanes));
        }
        few_steps.precision = Precision::binary64;
        few_steps.steps = 40;
        expect_same(run_script(name, text, few_steps, interpreted()),
                    run_script(name, text, few_steps, compiled(8, 3)), name + ", in double");
    }
}

}  // namespace
}  // namespace cascade

#endif
