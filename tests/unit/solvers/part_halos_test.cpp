// How many passes parts of a grid compute between two exchanges, and which halos these passes read.
#include "solvers/part_halos.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

int levels_on(const StepProblem& problem, int parts, std::int64_t thickness = least_thickness) {
    return levels_of_halo(problem, cut_grid(problem.grid, parts), thickness);
}

TEST(LevelsOfHalo, AreAnEighthOfThePartAndAtMost16) {
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 64}, 0.1F), 1), 1);
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 64}, 0.1F), 2), 4);
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 64}, 0.1F), 3), 2);
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 64}, 0.1F), 2, 2), 16);
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 2048}, 0.1F), 2), 16);
    EXPECT_EQ(levels_on(heat_problem(Grid{10, 20, Boundary::periodic, 64}, 0.1F), 4), 2);
}

TEST(LevelsOfHalo, AreOneIfAPassNeedsWholePlanesOrSidesHinder) {
    const Grid grid{10, 640};
    StepProblem problem = heat_problem(grid, 0.1F);
    ASSERT_EQ(levels_on(problem, 2), 16);
    problem.passes[0].reductions.emplace_back();
    EXPECT_EQ(levels_on(problem, 2), 1);
    problem = heat_problem(grid, 0.1F);
    problem.passes[0].filter.emplace();
    EXPECT_EQ(levels_on(problem, 2), 1);
    problem = heat_problem(grid, 0.1F);
    const std::vector<ChangingSide> changing(1);
    problem.changing_sides = changing;
    EXPECT_EQ(levels_on(problem, 2), 1);
    problem = heat_problem({10, 640, Boundary::no_flux}, 0.1F);
    problem.changing_sides = changing;
    EXPECT_EQ(levels_on(problem, 2), 16);
    EXPECT_FALSE(wraps_between_parts(problem));
    problem = heat_problem(grid, 0.1F);
    EXPECT_TRUE(wraps_between_parts(problem));
    problem.sides.assign(1, SideRules(grid.boundary));
    problem.sides[0].at[static_cast<std::size_t>(Side::bottom)].kind = SideKind::fixed;
    EXPECT_EQ(levels_on(problem, 2), 1);
}

TEST(HaloReads, AreThePlanesThatPassesReadBeforeTheyWriteThem) {
    const Grid grid{4, 40};
    const StepProblem problem = heat_problem(grid, 0.1F);
    Field one{PlaneLayout(grid)}, other{PlaneLayout(grid)};
    HaloReads reads(problem, 5);
    for (int step = 0; step < 5; ++step) {
        reads.add(0, [&](const StepProblem::PlaneRef& ref) {
            const bool is_old =
                std::get<StepProblem::SpeciesPlane>(ref).in_register == old_register;
            return is_old == (step % 2 == 0) ? &one : &other;
        });
    }
    EXPECT_EQ(reads.planes(), std::vector<Field*>{&one});
    EXPECT_EQ(reads.width(), 5);
}

}  // namespace
}  // namespace cascade::test
