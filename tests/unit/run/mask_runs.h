// What tests of masks share: scripts that have run, and their values.
#pragma once

#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace cascade::test {

inline std::string_view stepper() { return fastest_backend().name; }

/// A script with a simulation whose stages have run.
struct FinishedScript {
    Script script;
    std::unique_ptr<Simulation> simulation;
    std::string failure;

    const Field& field(const std::string& name, std::uint32_t stage = 0) const {
        const System& system = simulation->domain().program->system_of(stage);
        for (const ItemId item : system.quantities.ids()) {
            if (system.quantities[item].name == name) return simulation->state(stage).field(item);
        }
        ADD_FAILURE() << name;
        return simulation->state(stage).field({});
    }
    double number(const std::string& name, std::uint32_t stage = 0) const {
        const System& system = simulation->domain().program->system_of(stage);
        for (const ItemId item : system.quantities.ids()) {
            if (system.quantities[item].name == name) return simulation->state(stage).numbers[item];
        }
        ADD_FAILURE() << name;
        return 0;
    }
};

/// Runs every stage to its end. The result is on the heap, because the simulation refers to the
/// script in it.
inline std::unique_ptr<FinishedScript> finished_script(const std::string& text,
                                                       std::string_view backend = stepper()) {
    auto ran = std::make_unique<FinishedScript>();
    ran->script = load_script("test", text, ".");
    EXPECT_TRUE(ran->script.program) << text << ran->script.messages(false);
    if (!ran->script.program) return ran;
    auto simulation = Simulation::create(ran->script, {backend, 0, 2});
    if (!simulation) {
        ran->failure = ran->script.messages(false) + simulation.error().message;
        return ran;
    }
    ran->simulation = std::move(*simulation);
    RunControl control;
    for (std::uint32_t k = 0; k < ran->script.stage_count(); ++k) {
        if (auto started = ran->simulation->start_stage(k); !started) {
            ran->failure = started.error().message;
            break;
        }
        const auto last = ran->script.program->stages[k].iterations;
        if (auto end = ran->simulation->advance_stage(k, last, control, {}); !end) {
            ran->failure = end.error().message + " | " + end.error().hint;
            break;
        }
    }
    return ran;
}

/// The bits of a number. All NaN give the same bits.
inline std::uint32_t word(float value) {
    return std::isnan(value) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(value);
}

/// The sum over the grid, which is the sum over the domain, as cells outside are 0.
inline double sum_of(const Field& field) {
    double sum = 0;
    for (std::int64_t row = 0; row < field.layout().row_count(); ++row) {
        for (std::int64_t i = 0; i < field.layout().width; ++i) {
            sum += static_cast<double>(field.row(row)[i]);
        }
    }
    return sum;
}

}  // namespace cascade::test
