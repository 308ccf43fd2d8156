// The choice of a tiling, on made-up machines instead of a clock.
#include "solvers/tile_tuner.h"

#include "tests/unit/solvers/tiling_levels.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using test::levels;

const std::vector<Tiling> usual = {levels(16), levels(8), levels(1)};

/// The seconds that a sweep takes. `batch` is the number of earlier batches.
using Machine = std::function<double(const Tiling&, int batch)>;

/// The total time of a run that would take a given number of seconds with the first candidate.
struct Spent {
    double seconds = 0;
    int batches = 0;
    int trials = 0;  ///< The number of batches that were tried.
};

Spent run(TileTuner& tuner, double usual_seconds, const Machine& machine,
          std::int64_t sweeps_of_batch = 64) {
    const double usual_sweep = machine(tuner.candidates()[0], -1);
    auto left = static_cast<std::int64_t>(usual_seconds / usual_sweep);
    Spent spent;
    while (left > 0) {
        const std::int64_t most = tuner.is_trying() ? tuner.sweeps_of_trial() : sweeps_of_batch;
        const std::int64_t sweeps = std::min({most, sweeps_of_batch, left});
        spent.trials += tuner.is_trying();
        const double each = machine(tuner.tiling(), spent.batches++);
        const double took = each * static_cast<double>(sweeps);
        left -= sweeps;
        spent.seconds += took;
        tuner.took(sweeps, TileTuner::Seconds(took),
                   TileTuner::Seconds(each * static_cast<double>(left)));
    }
    return spent;
}

Machine fixed(double sixteen, double eight, double one) {
    return [=](const Tiling& tiling, int) {
        return tiling.levels == 16 ? sixteen : tiling.levels == 8 ? eight : one;
    };
}

TEST(TileTuner, KeepsTheFirstWhereNoneIsFaster) {
    TileTuner tuner(usual);
    const Spent taken = run(tuner, 10, fixed(1e-4, 1.1e-4, 2e-4));
    EXPECT_EQ(tuner.tiling(), usual[0]);
    EXPECT_EQ(tuner.how_found(), "the fastest of 3 ways");
    EXPECT_LT(taken.seconds, 10.05);
}

TEST(TileTuner, TakesWhatIsClearlyFaster) {
    TileTuner tuner(usual);
    run(tuner, 10, fixed(2e-4, 1.5e-4, 1e-4));
    EXPECT_EQ(tuner.tiling(), usual[2]);
    TileTuner other(usual);
    run(other, 10, fixed(2e-4, 1e-4, 1.5e-4));
    EXPECT_EQ(other.tiling(), usual[1]);
}

TEST(TileTuner, ALittleFasterIsNotEnough) {
    TileTuner tuner(usual);
    run(tuner, 10, fixed(1e-4, 0.96e-4, 0.97e-4));
    EXPECT_EQ(tuner.tiling(), usual[0]);
}

TEST(TileTuner, ADisturbedMomentDecidesNothing) {
    // If any one batch, or every third one, takes ten times as long, the fastest tiling is still
    // chosen.
    for (const double sweep : {1e-4, 1e-5}) {
        const Machine quiet = fixed(sweep, 1.2 * sweep, 1.3 * sweep);
        for (int disturbed = 0; disturbed < 120; ++disturbed) {
            for (const int every : {1000000, 3}) {
                TileTuner tuner(usual);
                run(tuner, 1, [&](const Tiling& tiling, int batch) {
                    return quiet(tiling, batch) * (batch % every == disturbed % every ? 10 : 1);
                });
                EXPECT_EQ(tuner.tiling(), usual[0]) << "batch " << disturbed;
                EXPECT_NE(tuner.how_found(), "");
            }
        }
    }
}

TEST(TileTuner, ShortRunsTryNothing) {
    for (const double seconds : {0.001, 0.01, 0.05, 0.1}) {
        TileTuner tuner(usual);
        EXPECT_EQ(run(tuner, seconds, fixed(1e-5, 1e-5, 1e-6)).trials, 0) << seconds << " s";
        EXPECT_EQ(tuner.how_found(), "");
    }
}

TEST(TileTuner, TrialsCostLittle) {
    // One tiling is many times as slow as the others. Steps are short, or so long that a tile takes
    // most of a second.
    for (const double sweep : {1e-6, 1e-4, 1e-2}) {
        for (const double seconds : {0.2, 1.0, 5.0, 25.0, 125.0}) {
            TileTuner tuner(usual);
            const Spent taken = run(tuner, seconds, fixed(sweep, sweep, 3 * sweep), 16);
            EXPECT_LT(taken.seconds, 1.04 * seconds)
                << "sweeps of " << sweep << " s, " << seconds << " s";
        }
    }
}

TEST(TileTuner, LongRunsWithLongStepsAreTunedToo) {
    TileTuner tuner(usual);
    const Spent taken = run(tuner, 500, fixed(2e-2, 2e-2, 1e-2), 16);
    EXPECT_EQ(tuner.tiling(), usual[2]);
    EXPECT_LT(taken.seconds, 300);
}

TEST(TileTuner, EachTrialHasWholeTiles) {
    TileTuner tuner(usual);
    run(tuner, 5, [&](const Tiling&, int) {
        EXPECT_TRUE(!tuner.is_trying() || tuner.sweeps_of_trial() % 16 == 0);
        return 3e-5;
    });
    EXPECT_NE(tuner.how_found(), "");
}

TEST(TileTuner, OfOneWayNothingIsTried) {
    TileTuner tuner({levels(4)});
    EXPECT_EQ(run(tuner, 100, [](const Tiling&, int) { return 1e-4; }).trials, 0);
    EXPECT_EQ(tuner.how_found(), "");
}

/// A memory of tilings that remembers one, for two threads.
class Memory : public TilingMemory {
public:
    std::optional<Tiling> known;
    int kept = 0;
    std::optional<Tiling> find(int threads) override { return threads == 2 ? known : std::nullopt; }
    void keep(int threads, const Tiling& tiling) override {
        EXPECT_EQ(threads, 2);
        known = tiling;
        ++kept;
    }
};

TEST(TileTuner, RemembersWhatItFound) {
    Memory memory;
    TileTuner first(usual, &memory, 2);
    run(first, 10, fixed(2e-4, 1.5e-4, 1e-4));
    EXPECT_EQ(memory.known, usual[2]);
    TileTuner second(usual, &memory, 2);
    EXPECT_EQ(second.tiling(), usual[2]);
    EXPECT_EQ(second.how_found(), "the fastest in an earlier run");
    EXPECT_EQ(run(second, 0.2, fixed(1e-4, 1e-4, 1e-4)).trials, 0);
}

TEST(TileTuner, WhatAnEarlierRunFoundIsTriedAgainSoon) {
    Memory memory;
    memory.known = usual[1];
    // Of equally fast tilings the first one is chosen.
    for (const double eight : {3e-5, 2e-5}) {
        TileTuner tuner(usual, &memory, 2);
        run(tuner, 0.5, fixed(2e-5, eight, 4e-5));
        EXPECT_EQ(tuner.tiling(), usual[0]);
        EXPECT_EQ(memory.known, usual[0]);
        memory.known = usual[1];
    }
}

TEST(TileTuner, KeepsWhatEachTrialFinds) {
    Memory memory;
    TileTuner tuner(usual, &memory, 2);
    run(tuner, 0.5, fixed(2e-5, 1e-5, 3e-5));
    EXPECT_EQ(tuner.tiling(), usual[1]);
    EXPECT_EQ(memory.kept, 1);
    run(tuner, 5, fixed(2e-5, 1e-5, 3e-5));
    EXPECT_EQ(memory.known, usual[1]);
    EXPECT_GT(memory.kept, 1);
}

TEST(TileTuner, WhatABusyMachineTaughtIsForgottenOnAQuietOne) {
    Memory memory;
    memory.known = usual[2];
    TileTuner tuner(usual, &memory, 2);
    const Spent taken = run(tuner, 10, fixed(1e-4, 1.5e-4, 2e-4));
    EXPECT_EQ(tuner.tiling(), usual[0]);
    EXPECT_EQ(memory.known, usual[0]);
    EXPECT_LT(taken.seconds, 14);
    // A tiling that was found in this run is tested again later, too.
    run(tuner, 60, fixed(2e-4, 1.5e-4, 1e-4));
    EXPECT_EQ(tuner.tiling(), usual[2]);
}

TEST(TileTuner, TriesMoreRarelyWhereNothingChanges) {
    TileTuner tuner(usual);
    const Machine same = fixed(1e-4, 1e-4, 1e-4);
    const int first = run(tuner, 20, same).trials;
    EXPECT_LT(run(tuner, 20, same).trials, first);
    EXPECT_LT(run(tuner, 200, same).trials, 3 * first);
}

TEST(TileTuner, WhatIsNoCandidateIsTriedAgain) {
    Memory memory;
    memory.known = levels(12);
    TileTuner tuner(usual, &memory, 2);
    EXPECT_EQ(tuner.tiling(), usual[0]);
    run(tuner, 10, fixed(1e-4, 1e-4, 1e-4));
    EXPECT_EQ(memory.known, usual[0]);
}

}  // namespace
}  // namespace cascade
