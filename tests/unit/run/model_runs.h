// Runs of scripts on models, for tests.
#pragma once

#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace cascade::test {

/// The first stage of a script on a model.
class ModelRun {
public:
    explicit ModelRun(const std::string& text, Precision precision = Precision::single,
                      SimulationOptions options = {"interp", 0, 2}) {
        Overrides overrides;
        overrides.precision = precision;
        script_ = std::make_unique<Script>(load_script("test", text, ".", overrides));
        EXPECT_TRUE(script_->program) << text << script_->messages(false);
        if (!script_->program) return;
        auto made = Simulation::create(*script_, options);
        EXPECT_TRUE(made) << (made ? "" : made.error().message) << script_->messages(false);
        if (made) simulation_ = std::move(*made);
    }

    void start() {
        if (!simulation_) return;
        const auto started = simulation_->start_stage(0);
        EXPECT_TRUE(started) << (started ? "" : started.error().message);
    }

    [[nodiscard]] bool steps(std::int64_t count) {
        if (!simulation_) return false;
        RunControl control;
        const auto end = simulation_->advance_stage(0, count, control, {});
        EXPECT_TRUE(end) << (end ? "" : end.error().message + end.error().hint);
        return end.has_value();
    }

    std::vector<double> values(const std::string& name) const {
        if (!simulation_) return {};
        const StageState& state = simulation_->state(0);
        const ItemId item = item_named(name);
        if (simulation_->domain().stage(0).uniform[item]) {
            return std::vector<double>(simulation_->domain().model->cells->count(),
                                       state.numbers[item]);
        }
        return cell_values(state.field(item), *simulation_->domain().model->cells);
    }

    double number(const std::string& name) const { return values(name).at(0); }

    /// The areas of the cells, in square units.
    std::vector<double> areas() const {
        if (!simulation_) return {};
        return cell_values(simulation_->domain()
                               .model->cells->spread()
                               .planes[static_cast<std::size_t>(ModelPlane::area)],
                           *simulation_->domain().model->cells);
    }

    /// Σ area · item, in square units. Without a name, the sum of the areas.
    double area_sum(const std::string& name) const {
        const std::vector<double> each = areas();
        const std::vector<double> of =
            name.empty() ? std::vector<double>(each.size(), 1) : values(name);
        double sum = 0;
        for (std::size_t k = 0; k < each.size(); ++k) sum += each[k] * of[k];
        return sum;
    }

    double spread(const std::string& name) const {
        const std::vector<double> of = values(name);
        return *std::max_element(of.begin(), of.end()) - *std::min_element(of.begin(), of.end());
    }

    /// The number of parts into which a step is cut, known after the first step, and 0 if it is not
    /// cut.
    std::uint32_t substeps() const { return simulation_ ? simulation_->state(0).time.stages : 0; }

    Simulation& simulation() { return *simulation_; }
    const Script& script() const { return *script_; }

private:
    ItemId item_named(const std::string& name) const {
        const System& system = simulation_->domain().program->system_of(0);
        for (const ItemId k : system.quantities.ids()) {
            if (system.quantities[k].name == name) return k;
        }
        ADD_FAILURE() << "no item " << name;
        return {};
    }

    std::unique_ptr<Script> script_;
    std::unique_ptr<Simulation> simulation_;
};

}  // namespace cascade::test
