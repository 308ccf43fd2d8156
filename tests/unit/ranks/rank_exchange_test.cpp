// Ranks exchange halos and sums. The results are compared with parts in one process and with whole
// planes.
#include "ranks/rank_exchange.h"
#include "ranks/ranks.h"
#include "tests/support/thread_messenger.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

Grid grid_of(std::int64_t width, std::int64_t height, std::int64_t depth) {
    Grid grid;
    grid.width = width;
    grid.height = height;
    grid.depth = depth;
    return grid;
}

/// A plane whose cells hold their numbers in the grid.
Field numbered(const PlaneLayout& layout, RowRange rows) {
    Field field(layout);
    for (std::int64_t row = rows.begin; row < rows.end; ++row) {
        for (std::int64_t i = -1; i <= layout.width; ++i) {
            field.row(row)[i] = static_cast<float>(1000 * row + i);
        }
    }
    return field;
}

/// The value of a cell. Rows before the first row of the field lie in slices before its first
/// slice.
float cell(const Field& field, std::int64_t i, std::int64_t row) {
    const PlaneLayout& layout = field.layout();
    if (layout.depth == 1) return field.at(i, row);
    const std::int64_t slice = (row + layout.height) / layout.height - 1;
    return field.at(i, row - slice * layout.height, slice);
}

/// Expects that a row of a part is row `source` of the grid, halo columns included.
void expect_row(const Field& field, std::int64_t row, std::int64_t source) {
    for (std::int64_t i = -1; i <= field.layout().width; ++i) {
        ASSERT_EQ(cell(field, i, row), static_cast<float>(1000 * source + i)) << row << " " << i;
    }
}

class OnGrids : public ::testing::TestWithParam<std::tuple<int, std::int64_t, bool>> {};

TEST_P(OnGrids, HalosAreTheRowsOfOtherRanks) {
    const auto [count, depth, wraps] = GetParam();
    const Grid grid = grid_of(9, 7, depth);
    const std::int64_t rows = grid.height * depth, layer = depth > 1 ? grid.height : 1;
    on_ranks(count, [&, wraps = wraps](Messenger& messenger) {
        RankLoad load;
        RankExchange exchange(grid, messenger, load);
        const RowRange own = exchange.rows();
        Field field = numbered(PlaneLayout(grid, own), own);
        const Exchange::Shared shared{&field, wraps};
        exchange.fill_halos({&shared, 1}, 1);
        for (std::int64_t row = own.begin; row < own.end; ++row) expect_row(field, row, row);
        for (std::int64_t k = 1; k <= layer; ++k) {
            const std::int64_t above = own.begin - k, below = own.end + k - 1;
            if (above >= 0 || wraps) expect_row(field, above, (above + rows) % rows);
            if (above < 0 && !wraps) {
                EXPECT_EQ(cell(field, 0, above), 0);
            }
            if (below < rows || wraps) expect_row(field, below, below % rows);
            if (below >= rows && !wraps) {
                EXPECT_EQ(cell(field, 0, below), 0);
            }
        }
    });
}

TEST_P(OnGrids, WholePlanesAreGatheredAndScattered) {
    const auto [count, depth, wraps] = GetParam();
    const Grid grid = grid_of(5, 7, depth);
    const RowRange all{0, grid.height * depth};
    on_ranks(count, [&](Messenger& messenger) {
        RankLoad load;
        RankExchange exchange(grid, messenger, load);
        const RowRange own = exchange.rows();
        Field part = numbered(PlaneLayout(grid, own), own), back(PlaneLayout(grid, own));
        Field whole{PlaneLayout(grid)}, of_root{PlaneLayout(grid)};
        exchange.gather_everywhere({&part, 1}, {&whole, 1});
        for (std::int64_t row = 0; row < all.end; ++row) expect_row(whole, row, row);
        const Field* const from = &part;
        Field* const to = &of_root;
        exchange.gather({&from, 1}, {&to, exchange.is_root() ? std::size_t{1} : 0});
        const Field* const root = &of_root;
        Field* const again = &back;
        exchange.scatter({&root, exchange.is_root() ? std::size_t{1} : 0}, {&again, 1});
        for (std::int64_t row = own.begin; row < own.end; ++row) expect_row(back, row, row);
    });
}

TEST_P(OnGrids, SumsOfRowsReachAllRanks) {
    const auto [count, depth, wraps] = GetParam();
    const Grid grid = grid_of(5, 7, depth);
    on_ranks(count, [&](Messenger& messenger) {
        RankLoad load;
        RankExchange exchange(grid, messenger, load);
        std::vector<double> rows(static_cast<std::size_t>(grid.height * grid.depth), -1);
        for (std::int64_t row = exchange.rows().begin; row < exchange.rows().end; ++row) {
            rows[static_cast<std::size_t>(row)] = static_cast<double>(row);
        }
        std::vector<double>* const shared = &rows;
        exchange.share_rows({&shared, 1});
        for (std::size_t row = 0; row < rows.size(); ++row) {
            EXPECT_EQ(rows[row], static_cast<double>(row));
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Ranks, OnGrids,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4, 7),
                                            ::testing::Values(std::int64_t{1}, std::int64_t{8}),
                                            ::testing::Bool()));

TEST(RankExchange, CountsTheBytesOfHalos) {
    const Grid grid = grid_of(100, 12, 1);
    on_ranks(3, [&](Messenger& messenger) {
        RankLoad load;
        RankExchange exchange(grid, messenger, load);
        Field field(PlaneLayout(grid, exchange.rows()));
        const Exchange::Shared shared{&field, true};
        exchange.fill_halos({&shared, 1}, 1);
        EXPECT_EQ(load.halo_bytes, 2 * field.layout().stride * std::int64_t{4});
        EXPECT_EQ(load.halo_exchanges, 1);
    });
}

TEST(Ranks, AreRefusedIfTheyDiffer) {
    on_ranks(3, [](Messenger& messenger) {
        Ranks ranks(messenger);
        EXPECT_TRUE(ranks.compare("script", "stage a"));
        const auto same = ranks.compare("script", ranks.rank() == 2 ? "stage b" : "stage a");
        EXPECT_EQ(bool{same}, ranks.rank() != 2);
        if (!same) {
            EXPECT_EQ(same.error().message, "this rank and rank 0 do not have the same script");
        }
        EXPECT_EQ(ranks.finish(3), ranks.is_root() ? 3 : 0);
    });
}

TEST(Ranks, LearnTheLoadsOfAll) {
    on_ranks(3, [](Messenger& messenger) {
        Ranks ranks(messenger);
        ranks.load().computing = 1 + ranks.rank();
        const std::vector<RankLoad> all = ranks.loads();
        ASSERT_EQ(all.size(), 3u);
        for (int rank = 0; rank < 3; ++rank) {
            EXPECT_EQ(all[static_cast<std::size_t>(rank)].computing, 1 + rank);
        }
        EXPECT_NE(all[1].machine[0], 0);
        ranks.finish(0);
    });
}

TEST(Ranks, NameASlowRankOnce) {
    on_ranks(4, [](Messenger& messenger) {
        Ranks ranks(messenger);
        std::vector<std::string> told;
        ranks.tell_slow([&](const std::string& words) { told.push_back(words); });
        const auto work = [&](double seconds) {
            ranks.load().computing += seconds;
            ranks.compare_loads();
        };
        work(ranks.rank() == 2 ? 9 : 5);
        EXPECT_TRUE(told.empty());
        work(ranks.rank() == 2 ? 15 : 5);
        work(ranks.rank() == 2 ? 15 : 5);
        ASSERT_EQ(told.size(), 1u);
        EXPECT_EQ(told[0].find("rank 2 of 4 on "), 0u);
        EXPECT_NE(told[0].find(" takes 3.0 times as long"), std::string::npos);
        ranks.finish(0);
    });
}

TEST(SlowRank, TakesMoreThanTwiceTheMedian) {
    const auto found = [](const std::vector<double>& seconds) { return slow_rank(seconds); };
    EXPECT_FALSE(found({}));
    EXPECT_FALSE(found({5}));
    EXPECT_FALSE(found({5, 10}));
    EXPECT_FALSE(found({0.1, 0.9}));
    EXPECT_EQ(found({5, 11})->rank, 1u);
    EXPECT_EQ(found({30, 5, 5, 6, 7})->rank, 0u);
    EXPECT_DOUBLE_EQ(found({30, 5, 5, 6, 7})->times, 5);
    EXPECT_FALSE(found({5, 10, 10, 10}));
}

TEST(RankLoad, TimesOfStepsLeaveMessagesOut) {
    RankLoad load;
    const auto begin = std::chrono::steady_clock::now();
    {
        const TimeOfSteps steps(load);
        const TimeOfMessages messages(load);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    EXPECT_GE(load.messages, 0.02);
    EXPECT_LE(load.messages + load.computing, all.count());
}

}  // namespace
}  // namespace cascade::test
