// Steps that are abandoned because a run is to end: how much work is saved, and that the run can go
// on.
#include "solvers/advance.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <memory>

namespace cascade::test {
namespace {

Field random_field(const Grid& grid) {
    return make_field(grid, [](auto i, auto j) { return scatter(i, j); });
}

/// Begins two steps and sets `control.cancel` during them, then goes on to their end, and expects
/// the state after two undisturbed steps. Returns the work of the first call, in the units of
/// `work`. One step is `of_one_step` of these units.
int work_until_abandoned(const StepProblem& problem, int threads, std::atomic<int>& work,
                         RunControl& control, std::atomic<int>& cancels_at, int& of_one_step) {
    const Grid& grid = problem.grid;
    cancels_at = -1;
    std::vector<Field> expected = only_species(random_field(grid));
    work = 0;
    advance_quietly(problem, {.last_step = 1, .threads = threads}, expected);
    of_one_step = work;
    advance_quietly(problem, {.first_step = 1, .last_step = 2, .threads = threads}, expected);

    std::vector<Field> species = only_species(random_field(grid));
    TimeLoop loop(problem, {.last_step = 2, .threads = threads}, species, Progress{});
    work = 0;
    cancels_at = 1;
    StageOutcome outcome = loop.advance(2, 0, control, nullptr);
    const int done = work;
    EXPECT_TRUE(outcome.cancelled);
    EXPECT_FALSE(outcome.not_finite);
    EXPECT_EQ(outcome.steps, 0);
    EXPECT_EQ(cells_of(species[0]), cells_of(random_field(grid)));

    cancels_at = -1;
    control.cancel = false;
    outcome = loop.advance(2, 0, control, nullptr);
    EXPECT_FALSE(outcome.cancelled);
    EXPECT_EQ(outcome.steps, 2);
    EXPECT_EQ(cells_of(species[0]), cells_of(expected[0]));
    return done;
}

TEST(AbandonedSteps, LeaveRowsOfALargeGridUndone) {
    for (const int threads : {1, 3}) {
        RunControl control;
        std::atomic<int> rows = 0, cancels_at = -1;
        const Grid grid{.width = 1024, .height = 512};
        const StepProblem problem =
            make_problem(grid, 1, [&](const CellView& cell, float* results) {
                if (cell.i == 0 && ++rows == cancels_at) control.cancel = true;
                results[0] = cell.field(0) + 0.1F * cell.laplacian(0);
            });
        int all = 0;
        const int done = work_until_abandoned(problem, threads, rows, control, cancels_at, all);
        EXPECT_EQ(all, 512);
        EXPECT_LE(done, 256);
    }
}

/// u' = phi, where 0 = k lap(phi) - phi + u and k jumps from cell to cell. Each evaluation of the
/// terms with phi counts as one unit of work.
StepProblem problem_with_constraint(const Grid& grid, const Field& factor,
                                    const std::shared_ptr<Field>& unknown,
                                    const std::function<void(const CellView&)>& watch) {
    const auto part = [&](CellFunction function) {
        auto made = std::make_shared<StepProblem>(make_problem(grid, 1, std::move(function)));
        made->passes[0].fields.push_back(fixed_plane(*unknown));
        made->passes[0].fields.push_back(fixed_plane(factor));
        made->passes[0].results = {{TemporaryId(0)}};
        made->temporaries = 1;
        return made;
    };
    StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
        results[0] = cell.field(0) + 0.5F * cell.field(1);
    });
    problem.temporaries = 1;
    problem.passes[0].fields.push_back(TemporaryId(0));
    StepProblem::Solve solve;
    solve.target = TemporaryId(0);
    solve.sides = SideRules(grid.boundary);
    solve.in_register = old_register;
    solve.unknown = unknown;
    solve.report = std::make_shared<SolveReport>();
    solve.linear = part([watch](const CellView& cell, float* results) {
        watch(cell);
        results[0] = cell.field(2) * cell.laplacian(1) - cell.field(1);
    });
    solve.whole = part([](const CellView& cell, float* results) {
        results[0] = cell.field(2) * cell.laplacian(1) - cell.field(1) + cell.field(0);
    });
    problem.passes[0].solves.push_back(std::move(solve));
    return problem;
}

TEST(AbandonedSteps, LeaveIterationsOfConstraintsUndone) {
    const Grid grid{.width = 256, .height = 128};
    const Field factor =
        make_field(grid, [](auto i, auto j) { return scatter(i, j) < 0.5 ? 1 : 8; });
    for (const int threads : {1, 2}) {
        RunControl control;
        std::atomic<int> applied = 0, cancels_at = -1;
        const auto unknown = std::make_shared<Field>(PlaneLayout(grid));
        // The operator is found by applying it three times, and each iteration then applies it
        // twice.
        const StepProblem problem =
            problem_with_constraint(grid, factor, unknown, [&](const CellView& cell) {
                if (cell.i != 0 || cell.j != 0) return;
                if (++applied == 4 && cancels_at > 0) control.cancel = true;
            });
        int all = 0;
        const int done = work_until_abandoned(problem, threads, applied, control, cancels_at, all);
        EXPECT_GT(all, 9);
        EXPECT_LE(done, 5);
    }
}

}  // namespace
}  // namespace cascade::test
