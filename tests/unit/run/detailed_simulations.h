// A run and the run in finer cells that goes on from its end, for tests of --detail.
#pragma once

#include "measure/features.h"
#include "measure/spectrum.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"
#include "unit/run/simulation_options.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {

class DetailedSimulations {
public:
    /// Runs all stages, carries their values to a grid whose cells are shorter by the factor
    /// `times`, and lets the last stage settle there unless `settles` is false.
    explicit DetailedSimulations(const std::string& text, std::int64_t times = 2,
                                 SimulationOptions options = interpreted(), bool settles = true)
        : coarse_script_(std::make_unique<Script>(load_script("test", text, "."))),
          finer_script_(std::make_unique<Script>(coarse_script_->detailed(times))) {
        coarse = made(*coarse_script_, options);
        finer = made(*finer_script_, options);
        if (!coarse || !finer) return;
        RunControl control;
        const std::uint32_t count = coarse_script_->stage_count();
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto started = coarse->start_stage(k);
            EXPECT_TRUE(started) << (started ? "" : started.error().message);
            const std::int64_t most = coarse->domain().stage(k).iterations;
            EXPECT_TRUE(coarse->advance_stage(k, most, control, {})) << text;
        }
        const auto carried = finer->go_on_from(*coarse, count - 1);
        EXPECT_TRUE(carried) << (carried ? "" : carried.error().message);
        if (!settles) return;
        const std::int64_t last = finer->domain().program->stages[count - 1].iterations;
        const auto end = finer->advance_stage(count - 1, last, control, {});
        EXPECT_TRUE(end) << text << (end ? "" : end.error().message);
    }

    /// The plane of an item of a stage in one of the two runs.
    const Field& field(const Simulation& of, const std::string& name,
                       std::uint32_t stage = 0) const {
        return of.state(stage).field(item(of, name, stage));
    }
    static ItemId item(const Simulation& of, const std::string& name, std::uint32_t stage = 0) {
        const System& system = of.domain().program->system_of(stage);
        for (const ItemId id : system.items()) {
            if (system.item_name(id) == name) return id;
        }
        ADD_FAILURE() << "no item " << name;
        return {};
    }
    static std::vector<double> numbers(const Simulation& of, const Field& field) {
        if (of.domain().model) return cell_values(field, *of.domain().model->cells);
        std::vector<double> result;
        for (std::int64_t k = 0; k < of.domain().grid.depth; ++k) {
            for (std::int64_t j = 0; j < of.domain().grid.height; ++j) {
                for (std::int64_t i = 0; i < of.domain().grid.width; ++i)
                    result.push_back(field.number_at(i, j, k));
            }
        }
        return result;
    }
    static measure::Samples samples(const Simulation& of, const Field& field) {
        return measure::to_samples(field, of.domain().grid);
    }

    std::unique_ptr<Simulation> coarse, finer;

private:
    static std::unique_ptr<Simulation> made(Script& script, const SimulationOptions& options) {
        EXPECT_TRUE(script.program) << script.messages(false);
        if (!script.program) return nullptr;
        auto simulation = Simulation::create(script, options);
        EXPECT_TRUE(simulation) << script.messages(false);
        return simulation ? std::move(*simulation) : nullptr;
    }

    std::unique_ptr<Script> coarse_script_, finer_script_;
};

}  // namespace cascade::test
