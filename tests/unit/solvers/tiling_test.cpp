// The choice of the number of levels of a tiling.
#include "solvers/tiling.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace cascade::test {
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
}

TEST(Tiling, CountsEveryPlaneOnce) {
    StepProblem problem = heat_problem(Grid{2048, 2048}, 0.1f);
    const std::int64_t cells = PlaneLayout(problem.grid).stride * 2048;
    EXPECT_EQ(bytes_of_step(problem), 2 * 4 * cells);
    problem.passes[0].fields.push_back(problem.passes[0].fields[0]);
    EXPECT_EQ(bytes_of_step(problem), 2 * 4 * cells);
    const Field parameter;
    problem.passes[0].fields.push_back(fixed_plane(parameter));
    EXPECT_EQ(bytes_of_step(problem), 3 * 4 * cells);
}

TEST(Tiling, WideLayersTakeFewerSteps) {
    // A row of both copies takes 4 MiB, so the cache has room for one level only.
    const StepProblem problem = heat_problem(Grid{1 << 19, 640}, 0.1f);
    EXPECT_EQ(choose_tiling(problem, 1, caches).levels, 1);
}

TEST(Tiling, StepsThatNeedAllCellsAreTakenOneByOne) {
    StepProblem problem = heat_problem(Grid{2048, 2048}, 0.1f);
    problem.passes[0].reductions = {
        {ReductionKind::sum, problem.passes[0].fields[0], AggregateId(0)}};
    EXPECT_EQ(choose_tiling(problem, 1, caches).levels, 1);
}

TEST(Tiling, LayersOfThinGridsHaveWhatACallIsWorth) {
    // Because of padding, a row of one cell takes as much memory as a row of 48 cells.
    const StepProblem thin = heat_problem(Grid{1, 100000}, 0.1f);
    const Tiling tiling = choose_tiling(thin, 1, caches);
    EXPECT_EQ(tiling.levels, 16);
    EXPECT_EQ(tiling.outer_layer, 34);
    EXPECT_TRUE(tiling.is_near);
    EXPECT_EQ(choose_tiling(heat_problem(Grid{512, 8192}, 0.1f), 1, caches).outer_layer, 3);
    EXPECT_EQ(choose_tiling(heat_problem(Grid{1024, 8192}, 0.1f), 1, caches).outer_layer, 1);
    for (const GridSize size : {GridSize{2, 1000003}, GridSize{17, 100003}, GridSize{1021, 4093}}) {
        const Tiling of_prime =
            choose_tiling(heat_problem(Grid{size.width, size.height}, 0.1f), 1, caches);
        EXPECT_EQ(of_prime.levels, 16) << size.width;
        EXPECT_TRUE(of_prime.is_near) << size.width;
    }
}

TEST(Tiling, LayersOfManyResultsHaveFewerRows) {
    StepProblem problem = heat_problem(Grid{256, 256}, 0.1f);
    problem.passes[0].results.resize(8, problem.passes[0].results[0]);
    const auto rows_of = [&] { return choose_tiling(problem, 1, {1 << 16, 1 << 18}).outer_layer; };
    EXPECT_EQ(rows_of(), 5);
    problem.passes[0].results.resize(16, problem.passes[0].results[0]);
    EXPECT_EQ(rows_of(), 2);
    problem.passes[0].results.resize(64, problem.passes[0].results[0]);
    EXPECT_EQ(rows_of(), 1);
}

TEST(Tiling, TriesLevelsThatFitIntoTheSecondCache) {
    // A row of both copies takes 65 KiB: 6 levels and the rows around them take 0.6 MiB.
    const StepProblem problem = heat_problem(Grid{8192, 512}, 0.1f);
    const std::vector<Tiling> tilings = tilings_to_try(problem, 1, caches, 1);
    EXPECT_TRUE(std::any_of(tilings.begin(), tilings.end(),
                            [&](const Tiling& tiling) { return tiling.levels == 6; }));
}

TEST(Tiling, LayersOfFewRowsAreColumns) {
    for (const GridSize size :
         {GridSize{10000019, 1}, GridSize{1000003, 8}, GridSize{90001, 5, 6}}) {
        const StepProblem problem =
            heat_problem(Grid{size.width, size.height, Boundary::periodic, size.depth}, 0.1f);
        const Tiling tiling = choose_tiling(problem, 1, caches);
        EXPECT_EQ(tiling.along, Tiling::Along::columns);
        EXPECT_EQ(tiling.outer_layer % PlaneLayout::row_pad, 0);
        EXPECT_EQ(tiling.levels, 16);
        EXPECT_TRUE(tiling.is_near);
        EXPECT_GT(tilings_to_try(problem, 1, caches, 1).size(), 2u);
    }
    // Threads share the columns of a row that stays in the cache.
    const Tiling in_cache = choose_tiling(heat_problem(Grid{1000, 1}, 0.1f), 1, caches);
    EXPECT_EQ(in_cache.along, Tiling::Along::columns);
    EXPECT_EQ(in_cache.levels, 1);
}

TEST(Tiling, LayersOfLongRowsAreColumns) {
    EXPECT_EQ(choose_tiling(heat_problem(Grid{1 << 19, 64}, 0.1f), 1, caches).along,
              Tiling::Along::columns);
    // If columns are too long as well, layers are whole rows.
    EXPECT_EQ(choose_tiling(heat_problem(Grid{1 << 19, 640}, 0.1f), 1, caches).along,
              Tiling::Along::slices);
}

TEST(Tiling, SidesThatVaryAlongRowsAndWithTimeKeepThemWhole) {
    StepProblem problem = heat_problem(Grid{10000019, 2}, 0.1f);
    std::vector<ChangingSide> sides(1);
    sides[0].side = Side::top;
    problem.changing_sides = sides;
    EXPECT_EQ(choose_tiling(problem, 1, caches).along, Tiling::Along::columns);
    sides[0].varies = true;
    EXPECT_EQ(choose_tiling(problem, 1, caches).along, Tiling::Along::slices);
}

TEST(Tiling, LayersOfFlatGridsAreRowsOfAllSlices) {
    const StepProblem flat = heat_problem(Grid{512, 512, Boundary::periodic, 4}, 0.1f);
    const Tiling tiling = choose_tiling(flat, 1, {1 << 20, 4 << 20});
    EXPECT_EQ(tiling.along, Tiling::Along::rows);
    EXPECT_EQ(tiling.outer_layer, 1);
    EXPECT_EQ(tiling.levels, 16);
    EXPECT_TRUE(tiling.is_near);
    const Grid cube{128, 128, Boundary::periodic, 128};
    EXPECT_EQ(choose_tiling(heat_problem(cube, 0.1f), 1, caches).along, Tiling::Along::slices);
}

TEST(Tiling, CandidatesBeginWithWhatFits) {
    const StepProblem large = heat_problem(Grid{2048, 2048}, 0.1f);
    const std::vector<Tiling> beyond = tilings_to_try(large, 1, caches, 1);
    EXPECT_EQ(beyond[0], choose_tiling(large, 1, caches));
    EXPECT_GT(beyond.size(), 2u);
    // For a grid that fits into the third-level cache tiles are tried, and for one that fits into
    // the second-level cache none are.
    const StepProblem medium = heat_problem(Grid{640, 640}, 0.1f);
    const std::vector<Tiling> in_third = tilings_to_try(medium, 1, caches, 1);
    EXPECT_EQ(in_third[0], Tiling());
    EXPECT_GT(in_third.size(), 1u);
    EXPECT_GT(in_third[1].levels, 1);
    EXPECT_EQ(tilings_to_try(heat_problem(Grid{128, 128}, 0.1f), 1, caches, 1).size(), 1u);
    for (const auto& tilings : {beyond, in_third}) {
        for (std::size_t k = 1; k < tilings.size(); ++k) {
            const auto at = tilings.begin() + static_cast<std::ptrdiff_t>(k);
            EXPECT_EQ(std::find(tilings.begin(), at, *at), at) << "each is tried once";
        }
    }
}

TEST(Tiling, CutsLargeSlices) {
    const StepProblem problem = heat_problem(Grid{1024, 1024, Boundary::periodic, 1024}, 0.1f);
    const Tiling tiling = choose_tiling(problem, 1, caches);
    EXPECT_GT(tiling.levels, 1);
    EXPECT_GT(tiling.inner_bands, 1);
    EXPECT_FALSE(tiling.is_near);
}

TEST(Tiling, SidesWrapWhereAnyPlaneDoes) {
    StepProblem problem = heat_problem(Grid{64, 64, Boundary::no_flux}, 0.1f);
    EXPECT_FALSE(wraps(problem, Side::top));
    problem.sides = {
        SideRules(Boundaries(Boundary::no_flux, Boundary::periodic, Boundary::no_flux))};
    EXPECT_TRUE(wraps(problem, Side::top));
    EXPECT_FALSE(wraps(problem, Side::left));
}

}  // namespace
}  // namespace cascade::test
