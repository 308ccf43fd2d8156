// Scripts that are run to their ends without writing files, for tests of their results.
#pragma once

#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// A script whose stages are run to their ends.
struct Ran {
    Script script;
    std::unique_ptr<Simulation> simulation;
    std::string failure;
    std::vector<std::string> warnings;
    /// Each ended stage or coarser grid of a stage, with its steps.
    std::vector<std::string> ended;

    const StageState& state(std::uint32_t stage = 0) const { return simulation->state(stage); }
    const StageState& last() const {
        return state(static_cast<std::uint32_t>(script.stage_count() - 1));
    }
    /// A species of the last stage.
    const Field& species(std::size_t number = 0) const { return last().species()[number]; }
};

inline Ran run_text(const std::string& text, const SimulationOptions& options = {"interp", 0, 1},
                    const Overrides& overrides = {}) {
    Ran ran;
    ran.script = load_script("test", text, ".", overrides);
    EXPECT_TRUE(ran.script.program) << ran.script.messages(false);
    if (!ran.script.program) return ran;
    auto made = Simulation::create(ran.script, options);
    EXPECT_TRUE(made);
    ran.simulation = std::move(*made);
    RunControl control;
    control.warn = [&](const std::string& warning) { ran.warnings.push_back(warning); };
    control.report = [&](const Progress& progress) {
        if (!progress.stage_done) return;
        ran.ended.push_back(progress.stage + progress.note + ": " + std::to_string(progress.step));
    };
    for (std::uint32_t k = 0; k < ran.script.stage_count() && ran.failure.empty(); ++k) {
        auto started = ran.simulation->start_stage(k);
        EXPECT_TRUE(started);
        const std::int64_t most = ran.script.program->stages[k].iterations;
        auto end = ran.simulation->advance_stage(k, most, control, {});
        if (!end) ran.failure = end.error().message + " | " + end.error().hint;
    }
    return ran;
}

}  // namespace cascade
