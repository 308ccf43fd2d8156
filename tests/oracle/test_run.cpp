// See test_run.h.
#include "tests/oracle/test_run.h"

#include "core/file.h"
#include "run/simulation/end_remarks.h"

#include <gtest/gtest.h>

namespace cascade {

TestRun::TestRun(std::string name, std::string text, Overrides overrides, SimulationOptions options)
    : is_cut_short_(overrides.steps.has_value()),
      is_other_solver_(overrides.solver.has_value()),
      script_(load_script(std::move(name), std::move(text), ".", std::move(overrides))) {
    if (!script_.program) {
        ADD_FAILURE() << script_.messages(false);
        return;
    }
    auto simulation = Simulation::create(script_, options);
    if (!simulation) {
        ADD_FAILURE() << simulation.error().message;
        return;
    }
    simulation_ = std::move(*simulation);
}

void TestRun::check(const Result<void>& result) {
    if (result) return;
    ADD_FAILURE() << script_.name << ": " << result.error().message;
    failed_ = true;
}

void TestRun::start(std::uint32_t stage) {
    if (ok()) check(simulation_->start_stage(stage));
}

void TestRun::finish(std::uint32_t stage) {
    if (!ok()) return;
    RunControl control;
    control.warn = [&](const std::string& message) {
        ADD_FAILURE() << script_.name << ": " << message;
    };
    const std::int64_t last = program().stages[stage].iterations;
    const auto end = simulation_->advance_stage(stage, last, control, [] {});
    check(end ? Result<void>{} : Result<void>(tl::unexpected(end.error())));
    // Recipes and systems of the library get no remark, except that a pattern dies out on a plane
    // smaller than the plane for which it was written.
    const std::string remark = ok() ? remark_on(*simulation_, stage) : "";
    if (remark.find("dying out") != std::string::npos) return;
    if (is_cut_short_ && remark.find("still growing") != std::string::npos) return;
    // Runs with few steps may have a threshold that the pattern has not reached yet.
    const bool is_short = is_cut_short_ || script_.name == "test.cascade";
    if (is_short && remark.find("has no frozen cell") != std::string::npos) return;
    // The long steps of rkl1 are of first order, which is accurate enough for the features of a
    // pattern.
    if (is_other_solver_ && remark.find("errors in its time steps") != std::string::npos) return;
    EXPECT_EQ(remark, "") << script_.name;
}

void TestRun::finish_all() {
    for (std::uint32_t stage = 0; ok() && stage < program().stages.size(); ++stage) {
        start(stage);
        finish(stage);
    }
}

std::vector<double> TestRun::values(std::uint32_t stage, const std::string& name) const {
    const System& system = program().system_of(stage);
    const StageState& state = simulation_->state(stage);
    for (const ItemId item : system.items()) {
        if (system.item_name(item) != name) continue;
        if (program().stages[stage].uniform[item]) {
            return std::vector<double>(width() * height(), state.numbers[item]);
        }
        std::vector<double> values;
        const Field& field = state.field(item);
        field.visit([&](const auto& plane) {
            for (std::int64_t j = 0; j < plane.layout().height; ++j) {
                values.insert(values.end(), plane.row(j), plane.row(j) + plane.layout().width);
            }
        });
        return values;
    }
    ADD_FAILURE() << system.name << " has no " << name;
    return {};
}

std::string source_file(const std::string& path) {
    auto text = read_file(std::string(CASCADE_SOURCE_DIR) + "/" + path, std::uint64_t{16} << 20);
    if (!text) {
        ADD_FAILURE() << text.error().message;
        return {};
    }
    return *text;
}

SimulationOptions on_fastest_backend() {
    SimulationOptions options;
    options.threads = 1;
    return options;
}

}  // namespace cascade
