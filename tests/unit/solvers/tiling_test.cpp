// How many levels are chosen.
#include "solvers/tiling.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

constexpr CacheSizes caches{1 << 20, 8 << 20};

TEST(Tiling, StepsOneByOneInTheCache) {
    EXPECT_EQ(choose_tiling(heat_problem(Grid{256, 256}, 0.1f), 1, caches).levels, 1);
    EXPECT_TRUE(stays_in_cache(heat_problem(Grid{256, 256}, 0.1f), caches));
}

TEST(Tiling, TakesManyStepsAtOnceBeyondIt) {
    const StepProblem problem = heat_problem(Grid{2048, 2048}, 0.1f);
    const Tiling tiling = choose_tiling(problem, 1, caches);
    EXPECT_EQ(tiling.levels, 16);
    EXPECT_TRUE(tiling.is_near);
    EXPECT_EQ(words_for_stepping(problem, tiling.levels), "16 steps a pass");
}

TEST(Tiling, CountsEveryPlaneOnce) {
    StepProblem problem = heat_problem(Grid{2048, 2048}, 0.1f);
    const std::int64_t cells = PlaneLayout(problem.grid).stride * 2048;
    EXPECT_EQ(bytes_of_step(problem), 2 * 4 * cells);
    problem.passes[0].fields.push_back(problem.passes[0].fields[0]);
    EXPECT_EQ(bytes_of_step(problem), 2 * 4 * cells);
    float parameter = 0;
    problem.passes[0].fields.push_back(fixed_plane(&parameter));
    EXPECT_EQ(bytes_of_step(problem), 3 * 4 * cells);
}

TEST(Tiling, WideLayersTakeFewerSteps) {
    // A row of both copies has 4 MiB: one has room.
    const StepProblem problem = heat_problem(Grid{1 << 19, 64}, 0.1f);
    EXPECT_EQ(choose_tiling(problem, 1, caches).levels, 1);
}

TEST(Tiling, StepsThatNeedAllCellsAreTakenOneByOne) {
    StepProblem problem = heat_problem(Grid{2048, 2048}, 0.1f);
    problem.passes[0].reductions = {{ReductionKind::sum, problem.passes[0].fields[0], 0}};
    EXPECT_EQ(choose_tiling(problem, 1, caches).levels, 1);
    EXPECT_EQ(words_for_stepping(problem, 1), "one step a pass: its aggregates need every step");
}

TEST(Tiling, CutsLargeSlices) {
    const StepProblem problem = heat_problem(Grid{512, 512, Boundary::periodic, 64}, 0.1f);
    const Tiling tiling = choose_tiling(problem, 1, caches);
    EXPECT_GT(tiling.levels, 1);
    EXPECT_GT(tiling.inner_bands, 1);
    EXPECT_FALSE(tiling.is_near);
}

TEST(Tiling, SidesWrapWhereAnyPlaneDoes) {
    StepProblem problem = heat_problem(Grid{64, 64, Boundary::no_flux}, 0.1f);
    EXPECT_FALSE(wraps(problem, Side::top));
    problem.sides = {SideRules(Boundaries(Boundary::no_flux, Boundary::periodic, Boundary::no_flux))};
    EXPECT_TRUE(wraps(problem, Side::top));
    EXPECT_FALSE(wraps(problem, Side::left));
}

}  // namespace
}  // namespace cascade::testing
