// Farthest-first order, tested with all distances, which another algorithm computes.
#include "surface/nested_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cascade {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

/// A grid of cells whose edges have varied lengths. No edge connects its two parts.
SurfaceCells cells_in_two_parts() {
    constexpr std::uint32_t columns = 12, rows = 9, gap = 7;
    SurfaceCells cells;
    cells.places.resize(columns * rows);
    cells.areas.assign(columns * rows, 1);
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        const auto sum = static_cast<double>(from + to);
        cells.edges.push_back({to, 1, 1 + 0.4 * std::sin(1.7 * sum)});
    };
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t cell = y * columns + x;
            if (y > 0) add(cell, cell - columns);
            if (x > 0 && x != gap) add(cell, cell - 1);
            if (x + 1 < columns && x + 1 != gap) add(cell, cell + 1);
            if (y + 1 < rows) add(cell, cell + columns);
            cells.ends.push_back(cells.edges.size());
        }
    }
    return cells;
}

/// The lengths of the shortest ways between all pairs of cells (R. W. Floyd, 1962).
std::vector<std::vector<double>> all_distances(const SurfaceCells& cells) {
    const std::size_t count = cells.places.size();
    std::vector<std::vector<double>> ways(count, std::vector<double>(count, far_away));
    for (std::size_t cell = 0; cell < count; ++cell) {
        ways[cell][cell] = 0;
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            ways[cell][edge.neighbour] = edge.distance;
        }
    }
    for (std::size_t by = 0; by < count; ++by) {
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = 0; b < count; ++b) {
                ways[a][b] = std::min(ways[a][b], ways[a][by] + ways[by][b]);
            }
        }
    }
    return ways;
}

TEST(NestedOrder, EachCellIsAsFarAsPossibleFromThoseBeforeIt) {
    const SurfaceCells cells = cells_in_two_parts();
    const auto ways = all_distances(cells);
    const std::vector<std::uint32_t> order = nested_order(cells);
    std::vector<std::uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t k = 0; k < cells.places.size(); ++k) ASSERT_EQ(sorted[k], k);
    EXPECT_EQ(order[0], 0u);
    std::vector<double> nearest(order.size(), far_away);
    double before = far_away;
    for (std::size_t n = 0; n < order.size(); ++n) {
        const double taken = nearest[order[n]];
        const double farthest = *std::max_element(nearest.begin(), nearest.end());
        if (farthest == far_away) {
            EXPECT_EQ(taken, far_away) << n;
        } else {
            EXPECT_NEAR(taken, farthest, 1e-12) << n;
        }
        EXPECT_LE(taken, before * (1 + 1e-12));
        before = taken;
        for (std::size_t cell = 0; cell < order.size(); ++cell) {
            nearest[cell] = std::min(nearest[cell], ways[order[n]][cell]);
        }
    }
}

TEST(NestedOrder, OneCellIsAnOrder) {
    SurfaceCells cells;
    cells.places.resize(1);
    cells.ends = {0};
    EXPECT_EQ(nested_order(cells), (std::vector<std::uint32_t>{0}));
    EXPECT_TRUE(nested_order({}).empty());
}

}  // namespace
}  // namespace cascade
