// Every recipe has the expected look on both grids, with three seeds.
#include "tests/oracle/pattern_statistics.h"
#include "tests/oracle/recipe_looks.h"
#include "tests/oracle/test_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace cascade {
namespace {

Pattern2d pattern_of(const TestRun& run, const Look& look) {
    const auto stage = static_cast<std::uint32_t>(look.stage - 1);
    return {run.width(), run.height(), run.values(stage, look.species)};
}

double measure(const Pattern2d& pattern, const Look& look) {
    const auto below = [&](double value) { return value < look.level; };
    const auto above = [&](double value) { return value > look.level; };
    switch (look.measure) {
        case Measure::regions_below: return static_cast<double>(count_regions(pattern, below));
        case Measure::regions_above: return static_cast<double>(count_regions(pattern, above));
        case Measure::bumps: {
            const auto [low, high] =
                std::minmax_element(pattern.values.begin(), pattern.values.end());
            const double middle = (*low + *high) / 2;
            return static_cast<double>(
                count_regions(pattern, [&](double value) { return value > middle; }));
        }
        case Measure::area_below: return area_fraction(pattern, below);
        case Measure::area_above: return area_fraction(pattern, above);
        case Measure::peak_wavelength: return summarise_spectrum(pattern).peak_wavelength;
        case Measure::mean_wavelength: return summarise_spectrum(pattern).mean_wavelength;
        case Measure::anisotropy: return summarise_spectrum(pattern).anisotropy;
        case Measure::deviation: return moments(pattern).deviation;
    }
    return 0;
}

std::set<std::string> scripts() {
    std::set<std::string> names;
    for (const Look& look : recipe_looks()) names.insert(std::string(look.script));
    return names;
}

class RecipeTest : public testing::TestWithParam<std::string> {
protected:
    void expect_looks(int side, std::uint32_t seed, const std::string& solver = {}) {
        Overrides overrides;
        if (!solver.empty()) overrides.solver = solver;
        overrides.grid = {side, side};
        overrides.seed = seed;
        const std::string file = "examples/" + GetParam() + ".cascade";
        TestRun run(file, source_file(file), overrides, on_fastest_backend());
        run.finish_all();
        if (!run.ok()) return;
        for (const Look& look : recipe_looks()) {
            if (look.script != GetParam()) continue;
            const double value = measure(pattern_of(run, look), look);
            const Range& range = side == 64 ? look.at_64 : look.at_128;
            EXPECT_TRUE(value >= range.low && value <= range.high)
                << "stage " << look.stage << ", " << look.species << ", measure "
                << static_cast<int>(look.measure) << " at " << look.level << ": " << value
                << " is not in " << range.low << " … " << range.high;
        }
    }
};

TEST_P(RecipeTest, LooksAsItShould) {
    // Without native code the larger grid would take minutes.
    for (const int side : is_available("jit") ? std::vector{64, 128} : std::vector{64}) {
        for (std::uint32_t seed = 1; seed <= (is_available("jit") ? 3U : 1U); ++seed) {
            SCOPED_TRACE(std::to_string(side) + " cells, seed " + std::to_string(seed));
            expect_looks(side, seed);
        }
    }
}

/// These other solvers should give the pattern of Euler's method.
TEST_P(RecipeTest, LooksTheSameWithOtherSolvers) {
    if (!is_available("jit")) GTEST_SKIP() << "without native code this would take minutes";
    for (const char* solver : {"symplectic", "rk2", "rk4", "rk23", "rk45", "rkl1", "rkl2"}) {
        SCOPED_TRACE(solver);
        expect_looks(64, 1, solver);
    }
}

INSTANTIATE_TEST_SUITE_P(Scripts, RecipeTest, testing::ValuesIn(scripts()),
                         [](const auto& parameter) { return parameter.param; });

/// With so little noise, the front from the right border arrives before the noise makes stripes.
TEST(Squirrel, OnALargerGridNeedsLessNoise) {
    Overrides overrides;
    overrides.grid = {128, 128};
    overrides.sets = {"stage1.ai=random(1, 0.00001) + (x > 0.9)", "stage1.iterations=8000",
                      "stage2.iterations=1"};
    TestRun run("squirrel", source_file("examples/squirrel.cascade"), overrides,
                on_fastest_backend());
    run.finish_all();
    ASSERT_TRUE(run.ok());
    const Pattern2d stripes{run.width(), run.height(), run.values(0, "b")};
    EXPECT_GT(summarise_spectrum(stripes).anisotropy, 0.94);
}

/// Figure 3.2: seven valleys in a row of 60 cells. The theory's wavelength is 2π √(Db / s) = 8.9.
TEST(Figure32, HasSevenValleys) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        Overrides overrides;
        overrides.seed = seed;
        TestRun run("figure_3_2", source_file("examples/figure_3_2.cascade"), overrides,
                    on_fastest_backend());
        run.finish_all();
        ASSERT_TRUE(run.ok());
        const Pattern2d row{60, 1, run.values(0, "b")};
        EXPECT_EQ(count_regions(row, [](double b) { return b < 4; }), 7u);
        EXPECT_NEAR(summarise_spectrum(row).peak_wavelength, 60.0 / 7, 0.2);
        EXPECT_NEAR(moments(row).deviation, 2.75, 0.05);
        const auto [low, high] = std::minmax_element(row.values.begin(), row.values.end());
        EXPECT_NEAR(*low, 0, 0.01);
        EXPECT_NEAR(*high, 7.355, 0.05);
    }
}

/// In the frozen large spots of the leopard, a and b remain 4.
TEST(Leopard, HasGreyDiscs) {
    TestRun run("leopard", source_file("examples/leopard.cascade"), {}, on_fastest_backend());
    run.finish_all();
    ASSERT_TRUE(run.ok());
    const auto before = run.values(0, "b"), after = run.values(1, "b");
    for (std::size_t cell = 0; cell < before.size(); ++cell) {
        if (before[cell] >= 4) continue;
        ASSERT_EQ(after[cell], 4) << cell;
    }
}

/// The spots of the first stage are frozen and do not change.
TEST(Cheetah, KeepsItsLargeSpots) {
    TestRun run("cheetah", source_file("examples/cheetah.cascade"), {}, on_fastest_backend());
    run.finish_all();
    ASSERT_TRUE(run.ok());
    const auto before = run.values(0, "b"), after = run.values(1, "b");
    std::size_t frozen = 0;
    for (std::size_t cell = 0; cell < before.size(); ++cell) {
        if (before[cell] >= 4) continue;
        ++frozen;
        ASSERT_EQ(after[cell], before[cell]) << cell;
    }
    EXPECT_GT(frozen, 0u);
}

}  // namespace
}  // namespace cascade
