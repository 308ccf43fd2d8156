// The team of threads.
#include "core/parallel.h"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <new>
#include <thread>
#include <vector>

namespace cascade {
namespace {

TEST(SplitRows, PartsAreWholeAndNearlyEqual) {
    for (const std::int64_t rows : {0, 1, 7, 64, 1000003}) {
        for (const int count : {1, 2, 3, 8, 64}) {
            std::int64_t next = 0;
            for (int index = 0; index < count; ++index) {
                const RowRange part = split_rows(rows, index, count);
                EXPECT_EQ(part.begin, next);
                EXPECT_GE(part.end - part.begin, rows / count);
                EXPECT_LE(part.end - part.begin, rows / count + 1);
                next = part.end;
            }
            EXPECT_EQ(next, rows);
        }
    }
}

TEST(Team, HardwareHasThreads) { EXPECT_GE(hardware_threads(), 1); }

TEST(Team, EveryThreadWorksOnceARun) {
    for (const int size : {1, 2, 5, 16}) {
        Team team(size);
        EXPECT_EQ(team.size(), size);
        std::vector<int> count(static_cast<std::size_t>(size));
        for (int run = 0; run < 200; ++run) {
            team.run([&](int index) { ++count[static_cast<std::size_t>(index)]; });
            for (const int each : count) ASSERT_EQ(each, run + 1);
        }
    }
}

TEST(Team, TheCallerIsNumberZero) {
    Team team(3);
    std::vector<std::thread::id> ids(3);
    team.run([&](int index) { ids[static_cast<std::size_t>(index)] = std::this_thread::get_id(); });
    EXPECT_EQ(ids[0], std::this_thread::get_id());
    EXPECT_NE(ids[1], ids[0]);
    EXPECT_NE(ids[2], ids[1]);
}

TEST(Team, NobodyPassesABarrierEarly) {
    for (const int size : {1, 2, 4, 9}) {
        Team team(size);
        // Each thread adds the values that its neighbours had before the barrier. A thread that
        // runs ahead or is late changes the sums.
        std::vector<std::vector<std::uint64_t>> values(
            2, std::vector<std::uint64_t>(static_cast<std::size_t>(size), 1));
        constexpr int rounds = 2000;
        team.run([&](int index) {
            const auto n = static_cast<std::size_t>(index), all = static_cast<std::size_t>(size);
            for (std::size_t round = 0; round < rounds; ++round) {
                const auto& from = values[round % 2];
                values[(round + 1) % 2][n] = from[(n + 1) % all] + from[(n + all - 1) % all];
                team.barrier();
            }
        });
        // Sums double in each round, modulo 2^64, so they are 0 after 64 rounds.
        for (const std::uint64_t value : values[rounds % 2]) EXPECT_EQ(value, 0u);

        for (auto& copy : values) copy.assign(copy.size(), 1);
        team.run([&](int index) {
            const auto n = static_cast<std::size_t>(index), all = static_cast<std::size_t>(size);
            for (std::size_t round = 0; round < rounds; ++round) {
                const auto& from = values[round % 2];
                values[(round + 1) % 2][n] =
                    (3 * from[(n + 1) % all] + 5 * from[(n + all - 1) % all]) % 1000003;
                team.barrier();
            }
        });
        std::uint64_t expected = 1;
        for (int round = 0; round < rounds; ++round) expected = 8 * expected % 1000003;
        for (const std::uint64_t value : values[rounds % 2]) EXPECT_EQ(value, expected);
    }
}

TEST(Team, SomeWorkWhileOthersRest) {
    Team team(5);
    std::vector<int> count(5);
    std::vector<int> expected(5);
    std::atomic<int> before_barrier{0};
    for (int run = 0; run < 300; ++run) {
        const int active = run % 5 + 1;
        before_barrier = 0;
        team.run(
            [&](int index) {
                ++count[static_cast<std::size_t>(index)];
                ++before_barrier;
                team.barrier();
                EXPECT_EQ(before_barrier, active);
            },
            active);
        for (int index = 0; index < active; ++index) ++expected[static_cast<std::size_t>(index)];
        ASSERT_EQ(count, expected);
    }
}

TEST(Team, WorksInFlushedArithmetic) {
    Team team(3);
    std::vector<float> results(3, 1.0f);
    const volatile float smallest = 1.17549435e-38f;
    team.run([&](int index) { results[static_cast<std::size_t>(index)] = smallest * 0.5f; });
    for (const float result : results) EXPECT_EQ(result, 0.0f);
    EXPECT_GT(smallest * 0.5f, 0.0f);  // The caller's own environment is restored.
}

TEST(Team, HandsOnWhatAThreadThrows) {
    Team team(4);
    for (int thrower = 0; thrower < 4; ++thrower) {
        for (const bool meets_before : {false, true}) {
            std::atomic<int> ended{0};
            const auto work = [&](int index) {
                if (meets_before) team.barrier();
                if (index == thrower) throw std::bad_alloc();
                for (int k = 0; k < 3; ++k) team.barrier();
                ++ended;
            };
            EXPECT_THROW(team.run(work), std::bad_alloc);
            EXPECT_EQ(ended, 0) << "none passes a barrier without the others";
        }
        std::vector<int> passed(4, 0);
        team.run([&](int index) {
            for (int k = 0; k < 100; ++k) {
                team.barrier();
                ++passed[static_cast<std::size_t>(index)];
            }
        });
        EXPECT_EQ(passed, std::vector<int>(4, 100)) << "the team works as before";
    }
}

TEST(Team, SleepsBetweenRuns) {
    Team team(4);
    std::atomic<int> count{0};
    for (int run = 0; run < 3; ++run) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        team.run([&](int) { ++count; });
    }
    EXPECT_EQ(count, 12);
}

}  // namespace
}  // namespace cascade
