// The norms that choose steps and ends of stages count every cell of a model once, and not the
// copies that fill up the last row of planes: 520 cells lie in two rows of 512.
#include "model_runs.h"
#include "solvers/steady.h"
#include "solvers/step_control.h"
#include "unit/solvers/scheme_runner.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {
namespace {

using test::ModelRun;
using test::PlainState;
using test::SchemeRunner;

constexpr std::size_t cells_in_two_rows = 520;

std::string script_on_sphere(const std::string& system, const std::string& stage) {
    return fmt::format(
        "domain {{ surface: sphere; cells: {} }}\nsystem s {{ {} }}\nstage only: s {{ {} }}\n",
        cells_in_two_rows, system, stage);
}

/// The time that an adaptive run of u' = 20 u (1 − u) reaches after `steps` steps, if `copies`
/// copies of the last value count as cells too.
double time_by_hand(std::vector<double> start, std::size_t copies, int steps) {
    constexpr double tolerance = 1e-6, duration = 50;
    start.insert(start.end(), copies, double{start.back()});
    const auto rates = [](const PlainState& state, double) {
        PlainState changes = state;
        for (double& u : changes[0]) u = 20 * u * (1 - u);
        return changes;
    };
    SchemeRunner runner(make_scheme(Solver::rk45, 1, false), rates, {std::move(start)});
    StepControl control(0.001, order_of(Solver::rk45));
    const auto norm = [](const std::vector<double>& values) {
        double sum = 0;
        for (const double value : values) sum += value * value;
        return std::sqrt(sum / static_cast<double>(values.size()));
    };
    for (int taken = 0; taken < steps;) {
        const double step = std::min(control.step(), duration - runner.time());
        runner.attempt(step);
        const double error = norm(runner.error()[0]) / (tolerance * norm(runner.attempted()[0]));
        if (!control.judge(step, error)) continue;
        runner.accept();
        ++taken;
    }
    return runner.time();
}

TEST(ModelNorms, StepsAreChosenByTheErrorsOfCells) {
    constexpr int steps = 12;
    ModelRun run(script_on_sphere("u: 0.01 + 0.1 * x * x\n u' = 20 * u * (1 - u)",
                                  "duration: 50; solver: rk45; tolerance: 1e-6; speed: 0.001"),
                 Precision::binary64);
    run.start();
    const ModelCells& model = *run.simulation().domain().model->cells;
    ASSERT_EQ(model.grid().cell_count(), 1024);
    // The values are in the order of memory, in which copies of the last cell follow it.
    const std::vector<double> values = run.values("u");
    std::vector<double> start;
    for (std::size_t k = 0; k < cells_in_two_rows; ++k)
        start.push_back(values[model.cell_at(static_cast<std::int64_t>(k))]);
    ASSERT_TRUE(run.steps(steps));
    const double t = run.simulation().state(0).t, expected = time_by_hand(start, 0, steps);
    EXPECT_NEAR(t / expected, 1, 1e-9);
    EXPECT_GT(std::abs(time_by_hand(start, 1024 - cells_in_two_rows, steps) / expected - 1), 1e-3)
        << "copies that count are seen";
}

/// The step after which a stage has settled, judged by the fields that `look` makes of the stage's
/// planes.
template <typename Look>
std::int64_t settled_by_hand(const std::string& system, double tolerance, const Look& look) {
    ModelRun run(script_on_sphere(system, "iterations: 10000; speed: 1"), Precision::binary64);
    run.start();
    SteadyWatch watch;
    const auto fields = [&] {
        std::vector<Field> seen;
        seen.push_back(
            look(run.simulation().state(0).species()[0], *run.simulation().domain().model->cells));
        return seen;
    };
    watch.begin(fields());
    for (std::int64_t step = 10; step < 10000; step += 10) {
        if (!run.steps(step)) return -1;
        if (watch.settled(fields(), static_cast<double>(step), tolerance)) return step;
    }
    return -1;
}

TEST(ModelNorms, AStageHasSettledWhenItsCellsHave) {
    const std::string system = "k: 0.002 + 0.04 * x\n u: 0\n u' = k * (1 - u)";
    ModelRun run(script_on_sphere(system, "until: steady(1e-3); check: 10; speed: 1"),
                 Precision::binary64);
    run.start();
    ASSERT_TRUE(run.steps(1000000));
    const std::int64_t steps = run.simulation().state(0).steps;
    EXPECT_GT(steps, 100);
    EXPECT_EQ(steps, settled_by_hand(system, 1e-3, in_one_row));
    EXPECT_NE(steps,
              settled_by_hand(system, 1e-3,
                              [](const Field& field, const ModelCells&) { return field.clone(); }))
        << "copies that count are seen";
}

}  // namespace
}  // namespace cascade
