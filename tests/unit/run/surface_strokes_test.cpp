// Distances that strokes and pictures of a model read only once: their memory is bounded, and only
// the needed distances are computed.
#include "run/domain/surface_values.h"
#include "run/session/live_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace cascade {
namespace {

class SurfaceStrokes : public ::testing::Test {
protected:
    SurfaceStrokes() {
        SimulationOptions options;
        options.backend = "interp";
        auto begun = LiveRun::begin(load_script("test", script, "."), options, control_);
        EXPECT_TRUE(begun) << begun.error().messages(false);
        run_ = std::move(*begun);
    }

    Formula formula(const std::string& expression) {
        Diagnostics errors;
        auto checked = run_->number("test", expression, errors);
        EXPECT_TRUE(checked) << expression;
        return checked ? std::move(*checked) : Formula();
    }
    std::vector<double> values(const std::string& expression) {
        const auto field = std::move(run_->simulation().evaluate(formula(expression), 0)[0]);
        return cell_values(field, *run_->simulation().domain().model->cells);
    }

    static constexpr const char* script =
        "domain { surface: creature; cells: 2000 }\n"
        "stage s: turing_spots { iterations: 10; ka: 1/80 + 0.001*distance(0.5, 0.5, 0.5) }\n";

    RunControl control_;
    std::unique_ptr<LiveRun> run_;
};

TEST_F(SurfaceStrokes, OldDistancesAreReleased) {
    Team team(1);
    SurfaceValues values(*run_->script().program, *run_->simulation().domain().model->cells, team);
    const Formula own = formula("distance(0.5, 0.5, 0.5)");
    const Formula* const of_script[] = {&own};
    values.make(of_script, control_.cancel);
    for (int k = 0; k < 100; ++k) {
        const Formula stroke = formula(fmt::format("distance(0.1, {}, 0.2)", 0.01 * k));
        const Formula* const read[] = {&stroke};
        values.prepare(read);
        EXPECT_LE(values.count(), 2 + SurfaceValues::evaluations_kept);
    }
    const auto id = *own.nodes.back().as<SurfaceValueId>();
    const auto kept = cell_values(values.value(id), *run_->simulation().domain().model->cells);
    EXPECT_LT(*std::max_element(kept.begin(), kept.end()), 10);
}

TEST_F(SurfaceStrokes, AComparisonIsThatOfTheWholeDistance) {
    for (const double reach : {0.01, 0.1, 0.4, 3.0}) {
        for (int k = 0; k < 8; ++k) {
            const std::string distance =
                fmt::format("distance({}, {}, 0.4)", 0.1 * k, std::abs(0.7 - 0.1 * k));
            // The next expression is no plain comparison of the distance, so the distance to all
            // cells is computed.
            const auto quick = values(fmt::format("if({} < {}, 1, 0)", distance, reach));
            EXPECT_EQ(quick, values(fmt::format("if({} - {} < 0, 1, 0)", distance, reach)));
            EXPECT_EQ(quick, values(fmt::format("if({} > {}, 0, 1)", distance, reach)));
        }
    }
}

TEST_F(SurfaceStrokes, ADistanceThatWasComparedIsWholeWhenItIsRead) {
    const auto near = values("if(distance(0.2, 0.3, 0.4) < 0.05, 1, 0)");
    const auto all = values("distance(0.2, 0.3, 0.4)");
    EXPECT_LT(*std::max_element(all.begin(), all.end()), 10);
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(near[k], all[k] < 0.05 ? 1 : 0);
}

}  // namespace
}  // namespace cascade
