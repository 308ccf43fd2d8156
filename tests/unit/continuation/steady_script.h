// The steady problem of a script, for tests.
#pragma once

#include "continuation/branch.h"
#include "run/commands/followed_cells.h"
#include "run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace cascade::test {

using continuation::Index;
using continuation::Vector;

/// A script in double precision whose last stage has taken no step, and the equations of its steady
/// states. `p` is the varied parameter.
class SteadyScript {
public:
    explicit SteadyScript(const std::string& text) : script_(load_script("test", text, ".")) {
        EXPECT_TRUE(script_.program) << script_.messages(false) << text;
        if (!script_.program) return;
        SimulationOptions options;
        options.backend = "interp";
        options.threads = 1;
        simulation_ = Simulation::create(script_, options).value();
        EXPECT_TRUE(simulation_->start_stage(0)) << text;
        auto problem = continuation::SteadyProblem::create(
            program(), 0, followed_cells(*simulation_), item("p"),
            [&](const Formula& formula) { return followed_values(*simulation_, 0, formula); });
        EXPECT_TRUE(problem) << problem.error().message << text;
        if (problem) problem_.emplace(*std::move(problem));
    }

    const Program& program() const { return *simulation_->domain().program; }
    continuation::SteadyProblem& problem() { return *problem_; }
    double parameter() const { return simulation_->state(0).numbers[item("p")]; }

    ItemId item(const std::string& name) const {
        const System& system = program().system_of(0);
        for (const ItemId each : system.quantities.ids()) {
            if (system.item_name(each) == name) return each;
        }
        ADD_FAILURE() << "no item " << name;
        return {};
    }

    /// The present state, in the order of the problem's unknowns.
    Vector state() const { return followed_state(*simulation_, 0); }

    /// Takes the stage's steps.
    void advance() {
        RunControl control;
        EXPECT_TRUE(simulation_->advance_stage(0, program().stages[0].iterations, control, {}));
    }

private:
    Script script_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<continuation::SteadyProblem> problem_;
};

}  // namespace cascade::test
