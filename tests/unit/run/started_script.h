// A script whose first stage has its starting values, for tests of values computed from them.
#pragma once

#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace cascade::test {

inline Script load(const std::string& text) { return load_script("test", text, "."); }

/// Starts the first stage on the interpreter. Returns null, and fails the test, if the script has a
/// fault.
inline std::unique_ptr<Simulation> start(Script& script) {
    EXPECT_TRUE(script.program) << script.messages(false);
    if (!script.program) return nullptr;
    auto simulation = Simulation::create(script, {"interp", 0, 2});
    EXPECT_TRUE(simulation) << (simulation ? "" : simulation.error().message);
    if (!simulation) return nullptr;
    EXPECT_TRUE((*simulation)->start_stage(0));
    return std::move(*simulation);
}

/// The plane of an item of the first stage that differs from cell to cell.
inline const Field& result_of(const Simulation& simulation, const std::string& name) {
    const System& system = simulation.domain().program->system_of(0);
    for (const ItemId k : system.quantities.ids()) {
        if (system.quantities[k].name == name) return simulation.state(0).field(k);
    }
    ADD_FAILURE() << "no item " << name;
    return simulation.state(0).field({});
}

}  // namespace cascade::test
