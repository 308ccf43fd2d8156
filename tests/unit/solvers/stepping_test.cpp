// Descriptions of how steps went through memory, in words and numbers.
#include "solvers/stepping.h"

#include "tests/unit/solvers/cell_function_kernel.h"
#include "tests/unit/solvers/tiling_levels.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

/// Five passes, of which those in `with_sums` begin with a sum over all cells.
StepProblem five_passes(const std::vector<std::size_t>& with_sums) {
    StepProblem problem = heat_problem(Grid{1024, 1024}, 0.1f);
    problem.passes.resize(5, problem.passes[0]);
    for (const std::size_t pass : with_sums) {
        problem.passes[pass].reductions = {
            {ReductionKind::sum, problem.passes[pass].fields[0], AggregateId(0)}};
    }
    return problem;
}

TEST(SteppingTest, StepsOfOnePass) {
    const StepProblem problem = heat_problem(Grid{1024, 1024}, 0.1f);
    const Stepping tiled = stepping_with(problem, levels(16), 16, 2);
    EXPECT_EQ(tiled.in_words(), "16 steps a pass");
    EXPECT_EQ(tiled.sweeps_at_once, 16);
    EXPECT_EQ(tiled.meetings, 2.0 / 16);
    // Nineteen rows of both copies of the field are in use.
    EXPECT_NEAR(tiled.bytes_in_use,
                19 * 2 * 4 * static_cast<double>(PlaneLayout(problem.grid).stride), 1);
    const Stepping plain = stepping_with(problem, {}, 1, 1);
    EXPECT_EQ(plain.sweeps_at_once, 1);
    EXPECT_EQ(plain.meetings, 1);
    EXPECT_EQ(plain.bytes_in_use, 0);
}

TEST(SteppingTest, PassesThatNeedAllCellsBeginATile) {
    EXPECT_EQ(stepping_with(five_passes({}), levels(4), 4, 1).sweeps_at_once, 4);
    EXPECT_EQ(stepping_with(five_passes({}), levels(4), 4, 1).in_words(), "4 sweeps a pass");
    // The five passes make two tiles, of three and of two passes.
    const Stepping one = stepping_with(five_passes({0}), levels(4), 4, 2);
    EXPECT_EQ(one.sweeps_at_once, 2.5);
    EXPECT_EQ(one.meetings, 2 * 2 + 1);
    EXPECT_EQ(one.in_words(), "up to 4 sweeps a pass between its aggregates");
    // The third pass begins a tile, and the fourth one does, too. The second tile ends with the
    // first two passes of the next step.
    const Stepping two = stepping_with(five_passes({2, 3}), levels(4), 4, 2);
    EXPECT_EQ(two.sweeps_at_once, 2.5);
    const Stepping all = stepping_with(five_passes({0, 1, 2, 3, 4}), {}, 1, 1);
    EXPECT_EQ(all.sweeps_at_once, 1);
    EXPECT_EQ(all.meetings, 10);
    EXPECT_EQ(all.in_words(), "one step a pass: its aggregates need every step");
}

TEST(SteppingTest, StepsThatMayBeTakenBackAreTakenOneByOne) {
    StepProblem problem = five_passes({});
    problem.error_register = first_scratch_register;
    const Stepping tiled = stepping_with(problem, levels(16), 16, 2);
    EXPECT_EQ(tiled.sweeps_at_once, 5);
    EXPECT_EQ(tiled.meetings, 2);
    EXPECT_EQ(tiled.in_words(), "up to 5 sweeps a pass within a step");
    const Stepping plain = stepping_with(problem, {}, 1, 1);
    EXPECT_EQ(plain.sweeps_at_once, 1);
    EXPECT_EQ(plain.meetings, 5);
    EXPECT_EQ(plain.in_words(), "one step a pass: each may be taken back");
}

}  // namespace
}  // namespace cascade::test
