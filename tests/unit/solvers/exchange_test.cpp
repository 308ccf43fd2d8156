// Parts of grids, which fill their halos from each other.
#include "core/parallel.h"
#include "solvers/exchange.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace cascade::test {
namespace {

struct Parts {
    Grid grid;
    std::vector<RowRange> rows;
    Team team;
    LocalExchange::Board board;
    std::vector<std::unique_ptr<LocalExchange>> exchanges;

    Parts(const Grid& whole, int count)
        : grid(whole),
          rows(cut_grid(whole, count)),
          team(static_cast<int>(rows.size())),
          board(team, rows.size()) {
        for (std::size_t part = 0; part < rows.size(); ++part) {
            exchanges.push_back(std::make_unique<LocalExchange>(grid, rows, part, board));
        }
    }
    void on_all(const std::function<void(std::size_t)>& work) {
        team.run([&](int part) { work(static_cast<std::size_t>(part)); });
    }
};

/// A cell of a row, which may be in a halo.
float& cell(Field& field, std::int64_t row, std::int64_t column) {
    const PlaneLayout& layout = field.layout();
    if (!layout.has_halo_slices()) return field.at(column, row);
    const std::int64_t slice = (row + 10 * layout.height) / layout.height - 10;
    return field.at(column, row - slice * layout.height, slice);
}

float value_at(std::int64_t row, std::int64_t column) {
    return static_cast<float>(1000 * row + column);
}

/// A part's plane with values in its own rows and their halo columns, and −1 elsewhere.
Field plane_of(const Grid& grid, RowRange part, std::int64_t width) {
    Field field{PlaneLayout(grid, with_neighbours(grid, part, width - 1, true))};
    const RowRange held = with_neighbours(grid, part, width, true);
    for (std::int64_t row = held.begin; row < held.end; ++row) {
        const bool is_own = part.begin <= row && row < part.end;
        for (std::int64_t i = -1; i <= grid.width; ++i) {
            cell(field, row, i) = is_own ? value_at(row, i) : -1;
        }
    }
    return field;
}

void expect_halos(const Grid& grid, int count, std::int64_t width, bool wraps) {
    Parts parts(grid, count);
    std::vector<Field> planes;
    for (const RowRange& part : parts.rows) planes.push_back(plane_of(grid, part, width));
    parts.on_all([&](std::size_t part) {
        const std::vector<Exchange::Shared> own{{&planes[part], wraps}};
        parts.exchanges[part]->fill_halos(own, width);
    });
    const std::int64_t all = grid.height * grid.depth;
    for (std::size_t part = 0; part < planes.size(); ++part) {
        const RowRange held = with_neighbours(grid, parts.rows[part], width, true);
        for (std::int64_t row = held.begin; row < held.end; ++row) {
            const bool is_inside = 0 <= row && row < all;
            for (std::int64_t i = -1; i <= grid.width; ++i) {
                ASSERT_EQ(cell(planes[part], row, i),
                          is_inside || wraps ? value_at((row + all) % all, i) : -1)
                    << "part " << part << ", row " << row << ", width " << width;
            }
        }
    }
}

TEST(Parts, FillHalosOfAnyWidthFromTheRowsOfOthers) {
    for (const int count : {1, 2, 3, 5}) {
        for (const std::int64_t width : {1, 2, 5}) {
            for (const bool wraps : {false, true}) {
                expect_halos(Grid{7, 11}, count, width, wraps);
                expect_halos(Grid{7, 3, Boundary::periodic, 6}, count, width, wraps);
            }
        }
    }
}

TEST(Parts, AreWholeSlicesAndNoMoreThanThereAre) {
    EXPECT_EQ(cut_grid(Grid{4, 10}, 3), (std::vector<RowRange>{{0, 4}, {4, 7}, {7, 10}}));
    EXPECT_EQ(cut_grid(Grid{4, 10, Boundary::periodic, 3}, 2),
              (std::vector<RowRange>{{0, 20}, {20, 30}}));
    EXPECT_EQ(cut_grid(Grid{4, 2}, 5).size(), 2u);
    EXPECT_EQ(cut_grid(Grid{4, 1}, 5).size(), 1u);
}

TEST(Parts, GatherWhatTheRootHasScatteredWithTheHaloOfTheGrid) {
    for (const Grid& grid : {Grid{5, 7}, Grid{5, 2, Boundary::no_flux, 4}}) {
        Parts parts(grid, 3);
        Field whole{PlaneLayout(grid)}, again{PlaneLayout(grid)};
        const std::int64_t beyond = grid.depth > 1 ? grid.height : 1;
        const auto for_all_held = [&](const auto& use) {
            for (std::int64_t row = -beyond; row < grid.height * grid.depth + beyond; ++row) {
                for (std::int64_t i = -1; i <= grid.width; ++i) use(row, i);
            }
        };
        for_all_held([&](auto row, auto i) { cell(whole, row, i) = value_at(row, i); });
        parts.on_all([&](std::size_t part) {
            Field own{PlaneLayout(grid, parts.rows[part])};
            Field* const here = &own;
            Field *const from = &whole, *const to = &again;
            parts.exchanges[part]->scatter({&from, 1}, {&here, 1});
            EXPECT_EQ(cell(own, parts.rows[part].end, 1), value_at(parts.rows[part].end, 1));
            parts.exchanges[part]->gather({&here, 1}, {&to, 1});
        });
        for_all_held([&](auto row, auto i) { ASSERT_EQ(cell(again, row, i), value_at(row, i)); });
    }
}

TEST(Parts, CompleteTheNumbersOfAllRows) {
    Parts parts(Grid{4, 9}, 4);
    std::vector<std::vector<double>> numbers(4, std::vector<double>(9, -1));
    parts.on_all([&](std::size_t part) {
        for (std::int64_t row = parts.rows[part].begin; row < parts.rows[part].end; ++row) {
            numbers[part][static_cast<std::size_t>(row)] = static_cast<double>(row);
        }
        std::vector<double>* const own = &numbers[part];
        parts.exchanges[part]->share_rows({&own, 1});
    });
    for (const auto& each : numbers)
        EXPECT_EQ(each, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

}  // namespace
}  // namespace cascade::test
