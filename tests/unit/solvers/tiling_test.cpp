// How many levels are chosen, and the sizes of caches that they are chosen by.
#include "solvers/tiling.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

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
}

TEST(Tiling, SidesWrapWhereAnyPlaneDoes) {
    StepProblem problem = heat_problem(Grid{64, 64, Boundary::no_flux}, 0.1f);
    EXPECT_FALSE(wraps(problem, Side::top));
    problem.sides = {SideRules(Boundaries(Boundary::no_flux, Boundary::periodic, Boundary::no_flux))};
    EXPECT_TRUE(wraps(problem, Side::top));
    EXPECT_FALSE(wraps(problem, Side::left));
}

/// A folder as Linux describes the caches of a processor.
class CacheFolder {
public:
    CacheFolder()
        : path_(std::filesystem::path(::testing::TempDir()) / ("caches_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~CacheFolder() { std::filesystem::remove_all(path_); }
    void add(int index, const std::string& level, const std::string& type, const std::string& size,
             const std::string& shared) const {
        const auto folder = path_ / ("index" + std::to_string(index));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "level") << level << '\n';
        std::ofstream(folder / "type") << type << '\n';
        std::ofstream(folder / "size") << size << '\n';
        std::ofstream(folder / "shared_cpu_list") << shared << '\n';
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

TEST(CacheSizes, AreThoseOfOneThread) {
    const CacheFolder folder;
    folder.add(0, "1", "Data", "32K", "0");
    folder.add(1, "2", "Unified", "2048K", "0-1");
    folder.add(2, "3", "Unified", "64M", "0-3,8,10-12");
    const CacheSizes sizes = CacheSizes::described_in(folder.path());
    EXPECT_EQ(sizes.second, 1 << 20);
    EXPECT_EQ(sizes.third, 8 << 20);
}

TEST(CacheSizes, StayAsTheyAreWhereNothingIsSaid) {
    const CacheSizes usual;
    const CacheFolder folder;
    EXPECT_EQ(CacheSizes::described_in(folder.path()).second, usual.second);
    folder.add(0, "2", "Unified", "many", "0-");
    folder.add(1, "3", "Unified", "-5K", "");
    EXPECT_EQ(CacheSizes::described_in(folder.path()).second, usual.second);
    EXPECT_EQ(CacheSizes::described_in(folder.path()).third, usual.third);
}

}  // namespace
}  // namespace cascade::testing
