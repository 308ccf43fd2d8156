// Orders of cells contain each cell once, put neighbours near each other, and keep the links.
#include "surface/cell_order.h"

#include "tests/support/random_links.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace cascade {
namespace {

using Order = std::vector<std::uint32_t>;

bool has_each_once(Order order, std::size_t cells) {
    std::sort(order.begin(), order.end());
    Order all(cells);
    std::iota(all.begin(), all.end(), 0U);
    return order == all;
}

std::size_t link_count(const LinkList& links, std::uint32_t cell) {
    return links.ends[cell] - (cell == 0 ? 0 : links.ends[cell - 1]);
}

/// A square of side² cells in random order, each linked to the cells beside, above and below it.
struct Square {
    explicit Square(std::size_t side) : numbers(side * side) {
        std::iota(numbers.begin(), numbers.end(), 0U);
        test::RandomStream random(side);
        for (std::size_t k = numbers.size(); k > 1; --k) {
            std::swap(numbers[k - 1], numbers[random.below(k)]);
        }
        std::vector<std::set<std::uint32_t>> neighbours(numbers.size());
        for (std::size_t j = 0; j < side; ++j) {
            for (std::size_t i = 0; i < side; ++i) {
                const std::uint32_t cell = numbers[j * side + i];
                for (const std::size_t other : {j * side + i + 1, (j + 1) * side + i}) {
                    const bool is_beside = other == j * side + i + 1;
                    if (other >= numbers.size() || (is_beside && i + 1 == side)) continue;
                    neighbours[cell].insert(numbers[other]);
                    neighbours[numbers[other]].insert(cell);
                }
            }
        }
        for (const auto& of_cell : neighbours) {
            for (const std::uint32_t neighbour : of_cell) {
                links.neighbours.push_back(neighbour);
                links.weights.push_back(1);
            }
            links.ends.push_back(links.neighbours.size());
        }
    }
    std::vector<std::uint32_t> numbers;
    LinkList links;
};

double distance(std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; }

/// The largest and the mean difference between the numbers of linked cells.
struct LinkDistances {
    double largest = 0, mean = 0;
    explicit LinkDistances(const LinkList& links) {
        for (std::uint32_t cell = 0; cell < links.ends.size(); ++cell) {
            for (std::size_t k = link_count(links, cell); k > 0; --k) {
                const double apart = distance(cell, links.neighbours[links.ends[cell] - k]);
                largest = std::max(largest, apart);
                mean += apart / static_cast<double>(links.neighbours.size());
            }
        }
    }
};

TEST(CellOrder, LevelsPutNeighboursIntoBands) {
    constexpr std::size_t side = 60;
    const Square square(side);
    const Order order = order_by_levels(square.links);
    ASSERT_TRUE(has_each_once(order, side * side));
    // Levels begin at a corner, so they are diagonals of at most `side` cells.
    const LinkDistances spread(renumbered(square.links, order));
    EXPECT_LE(spread.largest, side + 1);
    EXPECT_GT(LinkDistances(square.links).mean, 900) << "before";
}

/// For steps, slices of cells are as long as their longest list of links, and linked cells are near
/// each other.
TEST(CellOrder, StepsHaveBandsAndLittleToFillUp) {
    constexpr std::size_t side = 60;
    const Square square(side);
    const LinkList links = renumbered(square.links, order_for_steps(square.links));
    EXPECT_LE(LinkDistances(links).largest, side + 1 + 2 * 64);
    const auto entries = [](const LinkList& list) {
        std::size_t sum = 0;
        for (std::uint32_t first = 0; first < list.ends.size(); first += 16) {
            std::size_t most = 0;
            for (std::uint32_t cell = first; cell < first + 16; ++cell) {
                most = std::max(most, link_count(list, cell));
            }
            sum += 16 * most;
        }
        return static_cast<double>(sum) / static_cast<double>(list.neighbours.size());
    };
    const LinkList by_levels = renumbered(square.links, order_by_levels(square.links));
    EXPECT_LT(entries(links), entries(by_levels));
    EXPECT_LT(entries(links), 1.02);
}

TEST(CellOrder, GroupsAreSortedByLinksWithinWindows) {
    constexpr std::size_t cells = 1000, window = 128;
    const LinkList links = test::random_links(cells, 5);
    Order order(cells);
    std::iota(order.begin(), order.end(), 0U);
    group_by_links(order, links, window);
    for (std::size_t k = 0; k < cells; ++k) {
        EXPECT_EQ(order[k] / window, k / window);
        if (k % window == 0) continue;
        const std::size_t before = link_count(links, order[k - 1]),
                          now = link_count(links, order[k]);
        EXPECT_TRUE(before < now || (before == now && order[k - 1] < order[k])) << k;
    }
}

// These random links have one direction, and some cells have no link.
TEST(CellOrder, LevelsReachEveryCell) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const std::size_t cells = 1 + 17 * (seed - 1);
        const LinkList links = test::random_links(cells, seed);
        const Order order = order_by_levels(links);
        ASSERT_TRUE(has_each_once(order, cells)) << seed;
        const LinkList renamed = renumbered(links, order);
        ASSERT_EQ(renamed.ends.size(), cells);
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            // The same links with the same weights, between renumbered cells.
            std::multiset<std::pair<std::uint32_t, double>> before, after;
            for (std::size_t k = link_count(links, order[cell]); k > 0; --k) {
                const std::size_t link = links.ends[order[cell]] - k;
                before.insert({links.neighbours[link], links.weights[link]});
            }
            std::uint32_t last = 0;
            for (std::size_t k = link_count(renamed, cell); k > 0; --k) {
                const std::size_t link = renamed.ends[cell] - k;
                after.insert({order[renamed.neighbours[link]], renamed.weights[link]});
                ASSERT_GE(renamed.neighbours[link], last);
                last = renamed.neighbours[link];
            }
            ASSERT_EQ(before, after) << seed;
        }
    }
}

}  // namespace
}  // namespace cascade
