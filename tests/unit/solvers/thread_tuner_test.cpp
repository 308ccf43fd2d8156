// The choice of a number of threads, on made-up machines.
#include "solvers/thread_tuner.h"

#include <functional>
#include <gtest/gtest.h>

namespace cascade {
namespace {

/// Runs batches of about 20 ms for `seconds` seconds. Returns the fraction of the time that was
/// spent with `wanted` threads.
double share_of(ThreadTuner& tuner, int wanted, double seconds,
                const std::function<double(int)>& seconds_per_step) {
    double total = 0, with_wanted = 0;
    while (total < seconds) {
        const double each = seconds_per_step(tuner.threads());
        const auto count = static_cast<std::int64_t>(0.02 / each) + 1;
        const double took = each * static_cast<double>(count);
        total += took;
        if (tuner.threads() == wanted) with_wanted += took;
        tuner.took(count, std::chrono::duration<double>(took));
    }
    return with_wanted / total;
}

TEST(ThreadTuner, KeepsAllWhereTheyHelp) {
    ThreadTuner tuner(8);
    EXPECT_EQ(tuner.threads(), 8);
    EXPECT_GT(share_of(tuner, 8, 20, [](int threads) { return 1e-3 / threads; }), 0.97);
}

TEST(ThreadTuner, GoesDownToOneWhereMeetingsAreSlow) {
    ThreadTuner tuner(8);
    const auto busy = [](int threads) { return threads == 1 ? 30e-6 : 250e-6; };
    share_of(tuner, 1, 5, busy);
    EXPECT_GT(share_of(tuner, 1, 20, busy), 0.9);
}

TEST(ThreadTuner, ComesBackWhenTheMachineIsFree) {
    ThreadTuner tuner(6);
    share_of(tuner, 1, 10, [](int threads) { return 1e-5 * threads; });
    share_of(tuner, 6, 20, [](int threads) { return 1e-3 / threads; });
    EXPECT_GT(share_of(tuner, 6, 20, [](int threads) { return 1e-3 / threads; }), 0.95);
}

TEST(ThreadTuner, FindsTheBestBetween) {
    ThreadTuner tuner(16);
    const auto two_cores_taken = [](int threads) { return threads <= 8 ? 1e-3 / threads : 1e-3; };
    share_of(tuner, 8, 5, two_cores_taken);
    EXPECT_GT(share_of(tuner, 8, 20, two_cores_taken), 0.9);
}

TEST(ThreadTuner, SlowStepsAreTriedRarely) {
    ThreadTuner tuner(4);
    EXPECT_GT(share_of(tuner, 4, 200, [](int threads) { return 4.0 / threads; }), 0.85);
}

TEST(ThreadTuner, OneThreadIsOneThread) {
    ThreadTuner tuner(1);
    EXPECT_EQ(share_of(tuner, 1, 5, [](int) { return 1e-3; }), 1);
}

}  // namespace
}  // namespace cascade
