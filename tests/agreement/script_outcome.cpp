#include "tests/agreement/script_outcome.h"

#include "tests/support/kernel_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cascade::test {

Outcome run_script(const std::string& name, const std::string& text, Overrides overrides,
                   const SimulationOptions& options, std::int64_t last_step) {
    Outcome outcome;
    const auto folder = std::filesystem::path(CASCADE_SOURCE_DIR) / "examples";
    Script script = load_script(name, text, folder, std::move(overrides));
    EXPECT_TRUE(script.program) << text << script.messages(false);
    if (!script.program) return outcome;
    auto simulation = Simulation::create(script, options);
    EXPECT_TRUE(simulation) << (simulation ? "" : simulation.error().message);
    if (!simulation) return outcome;
    RunControl control;
    for (std::uint32_t k = 0; k < script.stage_count() && outcome.failure.empty(); ++k) {
        if (auto started = (*simulation)->start_stage(k); !started) {
            outcome.failure = started.error().message;
            break;
        }
        const std::int64_t steps = std::min(last_step, script.program->stages[k].iterations);
        auto end = (*simulation)->advance_stage(k, steps, control, {});
        if (!end) outcome.failure = end.error().message + end.error().hint;
        for (const Field& field : (*simulation)->state(k).species()) {
            outcome.fields.push_back(field.clone());
        }
    }
    return outcome;
}

void expect_same(const Outcome& expected, const Outcome& found, const std::string& what) {
    EXPECT_EQ(expected.failure, found.failure) << what;
    EXPECT_EQ(same_bits(expected.fields, found.fields), "") << what;
}

}  // namespace cascade::test
