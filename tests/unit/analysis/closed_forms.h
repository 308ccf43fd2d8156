// A script's first stage, analysed.
#pragma once

#include "analysis/parameters.h"
#include "tests/unit/lang/check_helpers.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

namespace cascade::test {

/// A program and its analysis, which refers to the program.
struct Analysed {
    std::unique_ptr<Checked> script;
    std::optional<analysis::StageAnalysis> analysis;

    const analysis::StateAnalysis& first() const { return analysis->states.at(0); }
    const analysis::Dispersion& relation() const { return first().relation; }
};

inline Analysed analyse(const std::string& text) {
    Analysed result{check_text(text), {}};
    EXPECT_EQ(result.script->faults(), std::vector<std::string>()) << text;
    if (!result.script->program) return result;
    auto analysis = analysis::analyze_stage(*result.script->program, 0);
    EXPECT_TRUE(analysis) << analysis.error().message;
    if (analysis) result.analysis = std::move(*analysis);
    return result;
}

/// The item of a parameter of the first stage.
inline ItemId item_named(const Program& program, const std::string& name) {
    const System& system = program.system_of(0);
    for (const ItemId item : system.quantities.ids()) {
        if (system.quantities[item].name == name) return item;
    }
    ADD_FAILURE() << "no parameter " << name;
    return {};
}

/// The critical values of a parameter of the first stage.
inline std::vector<analysis::CriticalValue> critical(const Analysed& analysed,
                                                     const std::string& name, double low,
                                                     double high) {
    const Program& program = *analysed.script->program;
    const auto scan = analysis::scan_parameter(program, 0, {item_named(program, name), low, high},
                                               analysed.first().state.species);
    EXPECT_TRUE(scan) << scan.error().message;
    return scan ? scan->changes : std::vector<analysis::CriticalValue>();
}

}  // namespace cascade::test
