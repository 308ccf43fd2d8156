// The time loop reaches planes only through its executor. Results are the same with an executor
// that hands out copies of its planes, as a device would, and with parts of the grid that share
// only their halos.
#include "solvers/advance.h"
#include "solvers/executor.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace cascade::test {
namespace {

std::vector<Field> copies_of(const std::vector<Field>& planes) {
    std::vector<Field> copies;
    for (const Field& plane : planes) copies.push_back(plane.clone());
    return copies;
}

class DistantExecutor final : public Executor {
public:
    explicit DistantExecutor(std::unique_ptr<Executor> here) : here_(std::move(here)) {}

    const StepProblem& problem() const override { return here_->problem(); }
    void prepare(const StepProblem& problem) override { here_->prepare(problem); }

    const std::vector<Field>& fetch(int copy) override {
        return fetched_[copy] = copies_of(here_->fetch(copy));
    }
    const std::vector<Field>& fetch(RegisterId scratch) override {
        return fetched_[100 + static_cast<int>(scratch.index())] = copies_of(here_->fetch(scratch));
    }
    std::vector<Field> take(int copy) override { return copies_of(here_->take(copy)); }
    void put(int copy, std::vector<Field> species) override {
        here_->put(copy, copies_of(species));
        for (Field& field : species) std::fill_n(field.origin(), field.layout().width, -1e30F);
    }
    void exchange(RegisterId one, RegisterId other) override { here_->exchange(one, other); }
    void fill_halos(int copy, SideMoment moment) override { here_->fill_halos(copy, moment); }

    bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
             const std::atomic<bool>* cancel) override {
        fetched_.clear();
        return here_->run(clock, first, count, check, cancel);
    }
    std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                        const std::atomic<bool>* cancel) override {
        fetched_.clear();
        return here_->run_judged(clock, first, cancel);
    }
    bool is_finite(int copy) override { return here_->is_finite(copy); }

    int most_threads() const override { return here_->most_threads(); }
    void use_threads(int threads) override { here_->use_threads(threads); }
    std::vector<Tiling> tilings_to_try() const override { return here_->tilings_to_try(); }
    void use_tiling(const Tiling& tiling) override { here_->use_tiling(tiling); }
    int levels() const override { return here_->levels(); }
    Stepping stepping() const override { return here_->stepping(); }

private:
    std::unique_ptr<Executor> here_;
    std::map<int, std::vector<Field>> fetched_;
};

std::unique_ptr<Executor> make_distant_executor(const StepProblem& problem,
                                                std::vector<Field> species, int most_threads,
                                                bool keeps) {
    return std::make_unique<DistantExecutor>(
        make_thread_executor(problem, std::move(species), most_threads, keeps));
}

/// u' = growth · u² + lap u by Euler's method, with an estimate of the error of each step.
StepProblem growing_problem(const Grid& grid, float growth) {
    StepProblem problem = make_problem(grid, 1, [growth](const CellView& cell, float* results) {
        const float u = cell.field(0), step = cell.uniform(0);
        const float rate = growth * u * u + cell.laplacian(0);
        results[0] = u + step * rate;
        results[1] = step * step * growth * u * rate;
    });
    problem.registers = 3;
    problem.error_register = first_scratch_register;
    problem.passes[0].results.push_back(
        {StepProblem::SpeciesPlane{SpeciesId(0), first_scratch_register}});
    problem.passes[0].uniforms = {0};
    problem.passes[0].changing = {{UniformSlot(0), Sweep::Coefficient{1, true}}};
    return problem;
}

struct Ended {
    StageOutcome outcome;
    std::vector<float> cells;
    std::vector<std::vector<float>> seen;
};

Ended run_on(const MakeExecutor& executor, const StepProblem& problem, Schedule schedule) {
    schedule.executor = executor;
    std::vector<Field> species =
        only_species(make_field(problem.grid, [](auto i, auto j) { return 1 + scatter(i, j); }));
    Ended ended;
    RunControl control;
    ended.outcome = advance(problem, schedule, species, control, Progress{},
                            [&](std::int64_t, double, std::span<const Field> shown) {
                                ended.seen.push_back(cells_of(shown[0]));
                                return true;
                            });
    ended.cells = cells_of(species[0]);
    return ended;
}

Ended run_on_all(const StepProblem& problem, const Schedule& schedule) {
    Ended here = run_on(make_thread_executor, problem, schedule);
    for (const MakeExecutor& executor :
         {MakeExecutor(make_distant_executor), in_parts(2), in_parts(3, 1), in_parts(5)}) {
        const Ended other = run_on(executor, problem, schedule);
        EXPECT_EQ(here.outcome.steps, other.outcome.steps);
        EXPECT_EQ(here.outcome.t, other.outcome.t);
        EXPECT_EQ(here.seen, other.seen);
        EXPECT_EQ(here.cells, other.cells);
    }
    return here;
}

const Grid of_executors{37, 21, Boundary::no_flux};

TEST(Executors, MayLendCopiesToObservers) {
    Schedule schedule{.last_step = 300, .interval = 70, .threads = 2};
    schedule.time.clock.step = 0.1;
    EXPECT_EQ(run_on_all(heat_problem(of_executors, 0.2F), schedule).seen.size(), 4u);
}

TEST(Executors, MayExchangeHalosOnlyNowAndThen) {
    for (const Grid& grid : {Grid{37, 21}, Grid{5, 80}}) {
        Schedule schedule{.last_step = 300, .interval = 70};
        schedule.time.clock.step = 0.1;
        EXPECT_EQ(run_on_all(heat_problem(grid, 0.1F), schedule).seen.size(), 4u);
    }
}

TEST(Executors, MayKeepTheStatesOfAReplayToThemselves) {
    Schedule schedule{.last_step = 300, .check_every = 64};
    schedule.time.clock.step = 0.1;
    const Ended ended = run_on_all(growing_problem(of_executors, 0.05F), schedule);
    ASSERT_TRUE(ended.outcome.not_finite);
    EXPECT_TRUE(ended.outcome.not_finite->is_exact());
    EXPECT_FALSE(ended.outcome.last_checked.empty());
}

TEST(Executors, MayKeepJudgedStepsAndJumpsToThemselves) {
    Schedule schedule{.last_step = 1000, .end_time = 3};
    schedule.tolerance = 1e-3;
    schedule.judges_all = true;
    schedule.time.clock.step = schedule.time.control.step = 0.2;
    schedule.time_after = [](double t) { return t > 1 && t < 1.1 ? t + 0.1 : t; };
    const Ended ended = run_on_all(growing_problem(of_executors, -0.3F), schedule);
    EXPECT_TRUE(ended.outcome.ended);
    EXPECT_GT(ended.outcome.steps, 20);
}

TEST(Executors, MayKeepTheErrorsOfAFailedStepToThemselves) {
    Schedule schedule{.last_step = 100000, .end_time = 100};
    schedule.tolerance = 1e-3;
    schedule.judges_all = true;
    schedule.time.clock.step = schedule.time.control.step = 0.2;
    const Ended ended = run_on_all(growing_problem(of_executors, 0.5F), schedule);
    EXPECT_TRUE(ended.outcome.too_short || ended.outcome.not_finite);
}

}  // namespace
}  // namespace cascade::test
