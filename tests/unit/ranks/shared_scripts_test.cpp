// Whole scripts give the same bits on several ranks as in one process.
#include "core/run_control.h"
#include "ranks/ranks.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "tests/agreement/random_scripts.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/new_seed.h"
#include "tests/support/thread_messenger.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cascade::test {
namespace {

/// The fields of all stages, and the message of a failure.
struct Outcome {
    std::vector<Field> fields;
    std::string failure;
};

/// Runs a script with the interpreter, alone or on ranks.
Outcome outcome_of(const std::string& text, const Overrides& overrides, Ranks* ranks) {
    Outcome outcome;
    RunControl control;
    SimulationOptions options{"interp", 0, 1};
    if (ranks != nullptr) options.executor = ranks->executor(control.cancel);
    Script script = load_script("ranks", text, ".", overrides);
    EXPECT_TRUE(script.program) << text << script.messages(false);
    if (!script.program) return outcome;
    const auto simulation = Simulation::create(script, options);
    EXPECT_TRUE(simulation) << text;
    for (std::uint32_t k = 0; simulation && k < script.stage_count(); ++k) {
        const auto started = (*simulation)->start_stage(k);
        if (!started) outcome.failure = started.error().message;
        if (!started) break;
        const auto end =
            (*simulation)->advance_stage(k, script.program->stages[k].iterations, control, {});
        if (!end) outcome.failure = end.error().message + end.error().hint;
        for (const Field& field : (*simulation)->state(k).species()) {
            outcome.fields.push_back(field.clone());
        }
        if (!end) break;
    }
    EXPECT_FALSE(control.cancel);
    return outcome;
}

void expect_same_on_ranks(const std::string& text, const Overrides& overrides, int count) {
    const Outcome expected = outcome_of(text, overrides, nullptr);
    on_ranks(count, [&](Messenger& messenger) {
        Ranks ranks(messenger);
        const Outcome found = outcome_of(text, overrides, &ranks);
        const auto where = fmt::format("{} on rank {} of {}", text, ranks.rank(), count);
        EXPECT_EQ(expected.failure, found.failure) << where;
        EXPECT_EQ(same_bits(expected.fields, found.fields), "") << where;
    });
}

TEST(SharedScripts, RandomScripts) {
    const std::uint64_t first = new_seed();
    for (std::uint64_t seed = first; seed < first + 24; ++seed) {
        Overrides overrides;
        overrides.fast = seed % 4 == 3;
        if (seed % 3 == 2) overrides.precision = Precision::binary64;
        expect_same_on_ranks(random_script(seed), overrides, 2 + static_cast<int>(seed % 3));
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(SharedScripts, SolversOnPlanesAndVolumes) {
    constexpr const char* system = R"(
system s {{
  u: 1 - 0.5 * disc(0.5, 0.5, 0.2)
  v: random(0, 0.3)
  u' = 0.16 * lap(u) - u * v^2 + 0.037 * (1 - u) + 0.001 * mean(v over domain)
  v' = 0.08 * lap(v) + u * v^2 - 0.097 * v
}}
domain {{ grid: {}; boundary: {} }}
stage a: s {{ duration: 6; solver: {} }}
stage b: s {{ iterations: 3; u: a.u; v: a.v * a.v; frozen: a.v > 0.2 }}
)";
    int count = 0;
    // Parts of the last two grids are thick enough for several passes between two exchanges.
    for (const char* const grid : {"13, 9", "7, 6, 5", "9, 99", "5, 4, 36"}) {
        for (const char* const boundary : {"periodic", "noflux"}) {
            for (const char* const solver : {"euler", "rk4", "rk45", "rkl2"}) {
                const auto text = fmt::format(fmt::runtime(system), grid, boundary, solver);
                for (int ranks = 2; ranks <= 4; ++ranks, ++count) {
                    expect_same_on_ranks(text, {}, ranks);
                }
            }
        }
    }
    EXPECT_EQ(count, 96);
}

/// One rank computes these values for all ranks.
TEST(SharedScripts, WhatNeedsAllCells) {
    expect_same_on_ranks(R"(
system s { u: random(0, 1); u' = lap(u) + 0.1 * (convolve(exp(-distance^2), u, 3) - u) }
domain { grid: 16, 12 }
stage a: s { iterations: 4; speed: 0.1 }
)",
                         {}, 3);
    expect_same_on_ranks(R"(
system s { u: random(0, 1); u' = lap(u) - u^3 + u }
domain { grid: 16, 12 }
stage a: s { iterations: 4; speed: 0.5; solver: imex }
)",
                         {}, 3);
}

}  // namespace
}  // namespace cascade::test
