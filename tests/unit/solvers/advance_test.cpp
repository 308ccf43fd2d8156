// The time loop: frozen cells, threads, resuming, observing, cancelling, blow-ups.
#include "solvers/advance.h"

#include "tests/unit/solvers/cell_function_kernel.h"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <thread>

namespace cascade::test {
namespace {

/// Two species that excite each other, a species that is not read at neighbours, a parameter that
/// varies, a mask and the number of the step: everything that the loop passes to kernels.
struct Mixture {
    Grid grid;
    Field parameter;
    Mask frozen;
    StepProblem problem;

    explicit Mixture(const Grid& of) : grid(of), frozen(PlaneLayout(of)) {
        parameter = make_field(grid, [](auto i, auto j) { return scatter(j + 5, i) + 11.5; });
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                frozen.at(i, j) = scatter(i, j + 1000) < 0.2 ? 1 : 0;
            }
        }
        problem = make_problem(grid, 3, [](const CellView& cell, float* results) {
            const float a = cell.field(0), b = cell.field(1), count = cell.field(2);
            const bool still = cell.mask(0);
            const float s = 1.0f / 80;
            const float na = a + s * (16 - a * b) + 0.125f * cell.laplacian(0);
            const float nb = b + s * (a * b - b - cell.field(3)) + 0.03125f * cell.laplacian(1);
            results[0] = still ? a : na;
            results[1] = still ? b : (nb < 0 ? 0 : nb);
            results[2] = still ? count : count + cell.uniform(1);
        });
        problem.species_needs_halo[2] = false;
        problem.passes[0].results[2].needs_halo = false;
        problem.passes[0].fields.push_back(fixed_plane(parameter));
        problem.passes[0].masks = {&frozen};
        problem.passes[0].uniforms = {7, -1};
        problem.passes[0].changing = {{UniformSlot(1), StepProblem::CompleteSteps{}}};
    }

    std::vector<Field> start() const {
        std::vector<Field> species;
        species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 0.1 * scatter(i, j); }));
        species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 0.1 * scatter(j, i); }));
        species.push_back(make_field(grid, [](auto, auto) { return 0.5; }));
        return species;
    }
};

std::vector<std::vector<float>> all_cells(const std::vector<Field>& species) {
    std::vector<std::vector<float>> cells;
    for (const Field& field : species) cells.push_back(cells_of(field));
    return cells;
}

/// The same steps without halos: neighbours are found by arithmetic on cell numbers.
std::vector<std::vector<float>> steps_without_halo(const Mixture& mixture, int steps) {
    const Grid& grid = mixture.grid;
    auto now = all_cells(mixture.start());
    const auto beside = [&](std::int64_t i, std::int64_t n) {
        if (grid.boundary == Boundary::periodic) return (i + n) % n;
        return i < 0 ? 0 : (i >= n ? n - 1 : i);
    };
    for (int step = 0; step < steps; ++step) {
        auto next = now;
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                if (mixture.frozen.at(i, j)) continue;
                const auto cell = [&](std::size_t k, std::int64_t x, std::int64_t y) {
                    return now[k][static_cast<std::size_t>(beside(y, grid.height) * grid.width +
                                                           beside(x, grid.width))];
                };
                const auto lap = [&](std::size_t k) {
                    const float c = cell(k, i, j);
                    const float north = cell(k, i, j - 1), south = cell(k, i, j + 1);
                    const float east = cell(k, i + 1, j), west = cell(k, i - 1, j);
                    if (grid.height == 1) return (east + west) - 2.0f * c;
                    if (grid.width == 1) return (north + south) - 2.0f * c;
                    return ((north + south) + east) + west - 4.0f * c;
                };
                const float a = cell(0, i, j), b = cell(1, i, j), s = 1.0f / 80;
                const auto n = static_cast<std::size_t>(j * grid.width + i);
                const float beta = mixture.parameter.at(i, j);
                next[0][n] = a + s * (16 - a * b) + 0.125f * lap(0);
                next[1][n] = b + s * (a * b - b - beta) + 0.03125f * lap(1);
                if (next[1][n] < 0) next[1][n] = 0;
                next[2][n] = cell(2, i, j) + static_cast<float>(step);
            }
        }
        now = next;
    }
    return now;
}

/// A memory of tilings that has one tiling, for any number of threads.
class OneTiling : public TilingMemory {
public:
    explicit OneTiling(const Tiling& tiling) : tiling_(tiling) {}
    std::optional<Tiling> find(int) override { return tiling_; }
    void keep(int, const Tiling&) override { FAIL() << "nothing is tried where one is known"; }

private:
    Tiling tiling_;
};

TEST(ChosenTilings, ChangeNoBit) {
    // The grids are larger than a usual second-level cache, so that there are tilings to choose
    // from.
    for (const Grid& grid :
         {Grid{640, 400, Boundary::periodic}, Grid{211, 1013, Boundary::no_flux}}) {
        const Mixture mixture(grid);
        const std::vector<Tiling> candidates =
            tilings_to_try(mixture.problem, 1, CacheSizes::here(), 1);
        std::vector<std::vector<float>> expected;
        for (const Tiling& tiling : candidates) {
            OneTiling memory(tiling);
            for (const int threads : {1, 2}) {
                std::vector<Field> species = mixture.start();
                Schedule schedule;
                schedule.last_step = 21;
                schedule.check_every = 20;
                schedule.threads = threads;
                schedule.tilings = &memory;
                advance_quietly(mixture.problem, schedule, species);
                if (expected.empty()) expected = all_cells(species);
                EXPECT_EQ(all_cells(species), expected) << tiling.levels << " levels";
            }
        }
    }
}

class Grids : public ::testing::TestWithParam<Grid> {};

TEST_P(Grids, EqualStepsWithoutHalo) {
    const Mixture mixture(GetParam());
    std::vector<Field> species = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 77, .check_every = 10}, species);
    EXPECT_EQ(all_cells(species), steps_without_halo(mixture, 77));
}

TEST_P(Grids, FrozenCellsKeepTheirValues) {
    const Mixture mixture(GetParam());
    const auto before = all_cells(mixture.start());
    std::vector<Field> species = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 40}, species);
    const auto after = all_cells(species);
    for (std::int64_t j = 0; j < mixture.grid.height; ++j) {
        for (std::int64_t i = 0; i < mixture.grid.width; ++i) {
            const auto n = static_cast<std::size_t>(j * mixture.grid.width + i);
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(after[k][n] == before[k][n], mixture.frozen.at(i, j) != 0);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, Grids,
    ::testing::Values(Grid{64, 64, Boundary::periodic}, Grid{64, 64, Boundary::no_flux},
                      Grid{131, 1, Boundary::periodic}, Grid{1, 67, Boundary::no_flux},
                      Grid{2, 2, Boundary::periodic}, Grid{2, 2, Boundary::no_flux},
                      Grid{17, 31, Boundary::periodic}, Grid{1, 1, Boundary::periodic},
                      Grid{47, 3, Boundary::no_flux}));

TEST(Advance, NeighboursReadFrozenCells) {
    const Grid grid{3, 1, Boundary::no_flux};
    StepProblem problem = make_problem(grid, 1, [](const CellView& cell, float* results) {
        const float c = cell.field(0);
        results[0] = cell.mask(0) ? c : c + 0.25f * cell.laplacian(0);
    });
    Mask frozen{PlaneLayout(grid)};
    frozen.at(0, 0) = 1;
    problem.passes[0].masks = {&frozen};
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto i, auto) { return i == 0 ? 8.0 : 0.0; }));
    advance_quietly(problem, {.last_step = 2}, species);
    // The values are 8, 2, 0 after one step, and 8, 2 + (8 - 4 + 0)/4, 0 + (2 - 0)/4 after two.
    EXPECT_EQ(cells_of(species[0]), (std::vector<float>{8, 3, 0.5}));
}

TEST(Advance, ThreadsDoNotChangeABit) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
        const Mixture mixture(Grid{251, 199, boundary});
        std::vector<Field> alone = mixture.start();
        advance_quietly(mixture.problem, {.last_step = 70, .threads = 1}, alone);
        for (int threads = 2; threads <= 8; ++threads) {
            std::vector<Field> shared = mixture.start();
            advance_quietly(mixture.problem, {.last_step = 70, .threads = threads}, shared);
            EXPECT_EQ(all_cells(shared), all_cells(alone)) << threads << " threads";
        }
    }
}

TEST(Advance, ResumesWithTheSameBits) {
    const Mixture mixture(Grid{33, 21, Boundary::periodic});
    std::vector<Field> whole = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 200}, whole);
    std::vector<Field> parts = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 77}, parts);
    const StageOutcome outcome =
        advance_quietly(mixture.problem, {.first_step = 77, .last_step = 200}, parts);
    EXPECT_EQ(outcome.steps, 200);
    EXPECT_EQ(all_cells(parts), all_cells(whole));
}

TEST(Advance, NoStepsToTake) {
    const Mixture mixture(Grid{8, 8, Boundary::periodic});
    std::vector<Field> species = mixture.start();
    const StageOutcome outcome =
        advance_quietly(mixture.problem, {.first_step = 5, .last_step = 5}, species);
    EXPECT_EQ(outcome.steps, 5);
    EXPECT_FALSE(outcome.cancelled);
    EXPECT_EQ(all_cells(species), all_cells(mixture.start()));
}

TEST(Advance, ObservesAtMultiplesOfTheInterval) {
    const Mixture mixture(Grid{16, 16, Boundary::periodic});
    std::vector<Field> species = mixture.start();
    RunControl control;
    std::vector<std::int64_t> seen;
    const Observer observer = [&](std::int64_t step, double, std::span<const Field> shown) {
        seen.push_back(step);
        EXPECT_EQ(shown.data(), species.data());
        // The third species adds up the step numbers: 0.5 + 0 + 1 + ... + (step - 1).
        std::int64_t i = 0;
        while (mixture.frozen.at(i, 0)) ++i;
        EXPECT_EQ(shown[2].at(i, 0), 0.5f + static_cast<float>(step * (step - 1) / 2));
        return true;
    };
    const Schedule schedule{.last_step = 100, .interval = 30};
    advance(mixture.problem, schedule, species, control, Progress{}, observer);
    EXPECT_EQ(seen, (std::vector<std::int64_t>{30, 60, 90}));

    std::vector<Field> unobserved = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 100}, unobserved);
    EXPECT_EQ(all_cells(species), all_cells(unobserved));
}

TEST(Advance, ObservesAfterAResumeAndAtTheEnd) {
    const Mixture mixture(Grid{5, 4, Boundary::periodic});
    std::vector<Field> species = mixture.start();
    RunControl control;
    std::vector<std::int64_t> seen;
    advance(mixture.problem, {.first_step = 60, .last_step = 90, .interval = 15}, species, control,
            Progress{}, [&](std::int64_t step, double, std::span<const Field>) {
                seen.push_back(step);
                return true;
            });
    EXPECT_EQ(seen, (std::vector<std::int64_t>{75, 90}));
}

TEST(Advance, ObserverEndsTheStage) {
    const Mixture mixture(Grid{16, 16, Boundary::periodic});
    std::vector<Field> species = mixture.start();
    RunControl control;
    const StageOutcome outcome =
        advance(mixture.problem, {.last_step = 1000, .interval = 40}, species, control, Progress{},
                [](std::int64_t step, double, std::span<const Field>) { return step < 80; });
    EXPECT_EQ(outcome.steps, 80);
    EXPECT_FALSE(outcome.cancelled);
    std::vector<Field> expected = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 80}, expected);
    EXPECT_EQ(all_cells(species), all_cells(expected));
}

TEST(Advance, CancelStopsAtACompleteStep) {
    for (const int threads : {1, 3}) {
        const Mixture mixture(Grid{192, 128, Boundary::periodic});
        std::vector<Field> species = mixture.start();
        RunControl control;
        std::thread watcher([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
            control.cancel = true;
        });
        const auto before = std::chrono::steady_clock::now();
        const StageOutcome outcome =
            advance(mixture.problem, {.last_step = 1'000'000'000, .threads = threads}, species,
                    control, Progress{}, Observer{});
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
        watcher.join();
        EXPECT_TRUE(outcome.cancelled);
        EXPECT_GT(outcome.steps, 0);
        EXPECT_LT(took.count(), 5.0);
        std::vector<Field> expected = mixture.start();
        advance_quietly(mixture.problem, {.last_step = outcome.steps}, expected);
        EXPECT_EQ(all_cells(species), all_cells(expected));
    }
}

TEST(Advance, ReportsProgress) {
    const Mixture mixture(Grid{64, 64, Boundary::periodic});
    std::vector<Field> species = mixture.start();
    RunControl control;
    std::vector<Progress> reports;
    control.report = [&](const Progress& progress) {
        reports.push_back(progress);
        if (progress.steps_per_second > 0) control.cancel = true;
    };
    Progress about;
    about.stage = "large";
    about.stage_number = 2;
    about.stage_count = 3;
    const StageOutcome outcome =
        advance(mixture.problem, {.last_step = 1'000'000'000}, species, control, about, Observer{});
    ASSERT_GE(reports.size(), 3u);
    EXPECT_EQ(reports.front().step, 0);
    EXPECT_EQ(reports.front().steps_per_second, 0);
    EXPECT_LT(reports.front().seconds_left, 0);
    for (std::size_t n = 0; n < reports.size(); ++n) {
        EXPECT_EQ(reports[n].stage, "large");
        EXPECT_EQ(reports[n].stage_number, 2);
        EXPECT_EQ(reports[n].steps, 1'000'000'000);
        EXPECT_EQ(reports[n].stage_done, n + 1 == reports.size());
    }
    const Progress& last = reports.back();
    EXPECT_EQ(last.step, outcome.steps);
    EXPECT_NEAR(last.seconds_left * last.steps_per_second, 1e9, 1e9 * 0.01);
}

/// A problem whose values grow by a factor of 4 in each step where the mask is set. A value of 1
/// overflows in step 64 (2^128).
StepProblem exploding(const Grid& grid, const Mask& where) {
    StepProblem problem = make_problem(grid, 2, [](const CellView& cell, float* results) {
        results[0] = cell.field(0);
        results[1] = cell.mask(0) ? cell.field(1) * 4 : cell.field(1);
    });
    problem.passes[0].masks = {&where};
    return problem;
}

TEST(Advance, NamesTheStepAndTheCellOfABlowUp) {
    const Grid grid{300, 200, Boundary::periodic};
    Mask where{PlaneLayout(grid)};
    where.at(299, 150) = where.at(7, 151) = 1;  // The second cell comes later in row order.
    for (const std::int64_t check_every : {1, 10, 64, 100}) {
        for (const int threads : {1, 4}) {
            for (const std::int64_t first : {0, 1000}) {
                std::vector<Field> species;
                species.push_back(make_field(grid, scatter));
                species.push_back(make_field(grid, [](auto, auto) { return 1.0; }));
                const StageOutcome outcome = advance_quietly(exploding(grid, where),
                                                             {.first_step = first,
                                                              .last_step = first + 500,
                                                              .check_every = check_every,
                                                              .threads = threads},
                                                             species);
                ASSERT_TRUE(outcome.not_finite);
                EXPECT_EQ(outcome.not_finite->species, 1u);
                EXPECT_EQ(outcome.not_finite->column, 299);
                EXPECT_EQ(outcome.not_finite->row, 150);
                EXPECT_EQ(outcome.not_finite->step, first + 64);
                EXPECT_TRUE(outcome.not_finite->is_exact());
                EXPECT_EQ(outcome.steps, first + 63);
                EXPECT_EQ(species[1].at(299, 150), std::ldexp(1.0f, 126));
                EXPECT_EQ(species[1].at(0, 0), 1.0f);
                ASSERT_EQ(outcome.last_checked.size(), 2u);
                const std::int64_t looked = 63 / check_every * check_every;
                EXPECT_EQ(outcome.last_checked[1].at(7, 151),
                          std::ldexp(1.0f, static_cast<int>(2 * looked)));
            }
        }
    }
}

TEST(Advance, WithoutAKeptCopyTwoLooksEncloseABlowUp) {
    const Grid grid{300, 200, Boundary::periodic};
    Mask where{PlaneLayout(grid)};
    where.at(299, 150) = where.at(7, 151) = 1;
    const std::int64_t plane = 4 * PlaneLayout(grid).size();
    for (const std::int64_t bytes : {2 * plane - 1, 2 * plane}) {
        std::vector<Field> species;
        species.push_back(make_field(grid, scatter));
        species.push_back(make_field(grid, [](auto, auto) { return 1.0; }));
        const StageOutcome outcome = advance_quietly(
            exploding(grid, where),
            {.last_step = 500, .check_every = 10, .most_kept_bytes = bytes, .threads = 2}, species);
        ASSERT_TRUE(outcome.not_finite);
        EXPECT_EQ(outcome.not_finite->species, 1u);
        EXPECT_EQ(outcome.not_finite->column, 299);
        EXPECT_EQ(outcome.not_finite->row, 150);
        const bool keeps = bytes == 2 * plane;
        EXPECT_EQ(outcome.not_finite->is_exact(), keeps);
        EXPECT_EQ(outcome.not_finite->last_finite, keeps ? 63 : 60);
        EXPECT_EQ(outcome.not_finite->step, keeps ? 64 : 70);
        EXPECT_EQ(outcome.last_checked.size(), keeps ? 2u : 0u);
        EXPECT_FALSE(outcome.not_finite->at_start());
    }
}

TEST(Advance, AKeptCopyChangesNoBit) {
    const Grid grid{97, 61, Boundary::periodic};
    const Mixture mixture(grid);
    std::vector<Field> kept = mixture.start(), spared = mixture.start();
    advance_quietly(mixture.problem, {.last_step = 75, .check_every = 7}, kept);
    advance_quietly(mixture.problem, {.last_step = 75, .check_every = 7, .most_kept_bytes = 0},
                    spared);
    EXPECT_EQ(all_cells(spared), all_cells(kept));
}

TEST(Advance, NoPictureIsMadeOfValuesThatAreNotFinite) {
    const Grid grid{4, 4, Boundary::periodic};
    Mask where{PlaneLayout(grid)};
    where.at(2, 1) = 1;
    std::vector<Field> species;
    species.push_back(make_field(grid, scatter));
    species.push_back(make_field(grid, [](auto, auto) { return 1.0; }));
    RunControl control;
    std::int64_t last_seen = 0;
    const StageOutcome outcome =
        advance(exploding(grid, where), {.last_step = 200, .interval = 3, .check_every = 50},
                species, control, Progress{},
                [&](std::int64_t step, double, std::span<const Field>) {
                    last_seen = step;
                    return true;
                });
    ASSERT_TRUE(outcome.not_finite);
    EXPECT_EQ(outcome.not_finite->step, 64);
    EXPECT_EQ(last_seen, 63);
}

TEST(Advance, ABlowUpIsFoundAtTheEndOfTheStage) {
    const Grid grid{4, 4, Boundary::periodic};
    Mask where{PlaneLayout(grid)};
    where.at(3, 3) = 1;
    std::vector<Field> species;
    species.push_back(make_field(grid, scatter));
    species.push_back(make_field(grid, [](auto, auto) { return 1.0; }));
    const StageOutcome outcome =
        advance_quietly(exploding(grid, where), {.last_step = 64, .check_every = 1000}, species);
    ASSERT_TRUE(outcome.not_finite);
    EXPECT_EQ(outcome.not_finite->step, 64);
    EXPECT_EQ(outcome.steps, 63);
}

TEST(Advance, StartValuesThatAreNotFinite) {
    const Grid grid{4, 3, Boundary::periodic};
    const Mixture mixture(grid);
    std::vector<Field> species = mixture.start();
    species[1].at(3, 2) = std::numeric_limits<float>::infinity();
    species[1].at(2, 2) = -std::numeric_limits<float>::quiet_NaN();
    const StageOutcome outcome = advance_quietly(mixture.problem, {.last_step = 10}, species);
    ASSERT_TRUE(outcome.not_finite);
    EXPECT_EQ(outcome.not_finite->step, 0);
    EXPECT_TRUE(outcome.not_finite->at_start());
    EXPECT_EQ(outcome.not_finite->species, 1u);
    EXPECT_EQ(outcome.not_finite->column, 2);
    EXPECT_EQ(outcome.not_finite->row, 2);
    EXPECT_EQ(outcome.steps, 0);
    EXPECT_EQ(species.size(), 3u);
}

}  // namespace
}  // namespace cascade::test
