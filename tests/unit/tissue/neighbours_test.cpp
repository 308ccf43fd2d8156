// Lists of neighbours, compared with a search of all pairs.
#include "tissue/neighbours.h"

#include "tests/support/random_stream.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace cascade::test {
namespace {

struct Cells {
    std::vector<Vector3d> places;
    std::vector<double> radii;
    std::vector<std::uint32_t> ranks;
    CellPlaces view() const { return {places, radii, ranks}; }
};

double uniform(RandomStream& random) { return (random.symmetric() + 1.0) / 2; }

/// Cells in a box, whose numbers have another order than their memory.
Cells random_cells(std::size_t count, Vector3d size, double least, double most,
                   RandomStream& random) {
    Cells cells;
    for (std::size_t k = 0; k < count; ++k) {
        cells.places.push_back(
            {size.x * uniform(random), size.y * uniform(random), size.z * uniform(random)});
        cells.radii.push_back(least * std::pow(most / least, uniform(random)));
        cells.ranks.push_back(static_cast<std::uint32_t>(k));
    }
    for (std::size_t k = count; k > 1; --k) {
        std::swap(cells.ranks[k - 1], cells.ranks[random.below(k)]);
    }
    return cells;
}

double distance(Vector3d a, Vector3d b, const std::array<double, 3>& period) {
    const std::array<double, 3> apart{b.x - a.x, b.y - a.y, b.z - a.z};
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        double nearest = std::abs(apart[k]);
        if (period[k] > 0) nearest = std::abs(std::remainder(apart[k], period[k]));
        square += nearest * nearest;
    }
    return std::sqrt(square);
}

/// The lists of neighbours found among all pairs, in the order of the cells' numbers.
NeighbourLists all_pairs(const Cells& cells, const NeighbourRule& rule, double skin) {
    NeighbourLists lists;
    for (std::size_t i = 0; i < cells.places.size(); ++i) {
        std::vector<std::uint32_t> found;
        for (std::size_t j = 0; j < cells.places.size(); ++j) {
            const double touching = rule.reach * (cells.radii[i] + cells.radii[j]);
            const double slack =
                slack_of(rule, skin, cells.radii[i]) + slack_of(rule, skin, cells.radii[j]);
            const double limit = std::max(touching, rule.near) + slack;
            if (i != j && distance(cells.places[i], cells.places[j], rule.period) < limit) {
                found.push_back(static_cast<std::uint32_t>(j));
            }
        }
        std::sort(found.begin(), found.end(),
                  [&](auto a, auto b) { return cells.ranks[a] < cells.ranks[b]; });
        lists.neighbours.insert(lists.neighbours.end(), found.begin(), found.end());
        lists.ends.push_back(lists.neighbours.size());
    }
    return lists;
}

void expect_all_pairs(const Cells& cells, const NeighbourRule& rule, double skin) {
    const NeighbourLists expected = all_pairs(cells, rule, skin);
    for (const int threads : {1, 2, 3}) {
        Team team(threads);
        const auto found = find_neighbours(cells.view(), rule, skin, 1e9, team);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->ends, expected.ends);
        EXPECT_EQ(found->neighbours, expected.neighbours);
    }
}

TEST(Neighbours, AreAllPairsThatTouch) {
    RandomStream random(1);
    for (const std::size_t count : {1, 2, 17, 400}) {
        const Cells cells = random_cells(count, {1, 1, 1}, 0.05, 0.05, random);
        expect_all_pairs(cells, {1.2, 0, {}}, 0.2);
        expect_all_pairs(cells, {1.2, 0.3, {}}, 0.1);
    }
}

TEST(Neighbours, OfVeryDifferentRadii) {
    RandomStream random(2);
    const Cells cells = random_cells(600, {1, 2, 0.5}, 0.0005, 0.3, random);
    expect_all_pairs(cells, {1.2, 0, {}}, 0.15);
    expect_all_pairs(cells, {1.2, 0.02, {}}, 0.15);
}

TEST(Neighbours, ThroughPeriodicSides) {
    RandomStream random(3);
    for (const double radius : {0.01, 0.05, 0.12, 0.3}) {
        Cells cells = random_cells(300, {1, 0.7, 0}, radius / 3, radius, random);
        expect_all_pairs(cells, {1.2, 0, {1, 0.7, 0}}, 0.1);
        expect_all_pairs(cells, {1.2, 0, {0, 0.7, 0}}, 0.1);
        // Cells may have left the box without having been put back.
        for (Vector3d& place : cells.places) place.x += static_cast<double>(random.below(5)) - 2;
        expect_all_pairs(cells, {1.2, 0, {1, 0, 0}}, 0.1);
    }
}

TEST(Neighbours, OfCellsThatAreFarAway) {
    RandomStream random(4);
    Cells cells = random_cells(200, {1, 1, 1}, 0.05, 0.1, random);
    cells.places[3] = {1e12, -1e12, 0};
    cells.places[4] = {1e12, -1e12, 0};
    cells.places[5] = {-1e300, 1e300, 0};
    cells.radii[7] = 0;
    expect_all_pairs(cells, {1.2, 0, {}}, 0.2);
}

TEST(Neighbours, OfPoints) {
    Cells cells;
    cells.places = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    cells.radii = {0, 0, 0};
    cells.ranks = {0, 1, 2};
    expect_all_pairs(cells, {1.2, 0, {}}, 0.2);
    expect_all_pairs(cells, {1.2, 0.5, {}}, 0.2);
}

TEST(Neighbours, AreRefusedIfThereWouldBeTooMany) {
    RandomStream random(5);
    const Cells cells = random_cells(20000, {1, 1, 1}, 0.01, 0.01, random);
    Team team(1);
    const auto refused = find_neighbours(cells.view(), {1.2, 10, {}}, 0.1, 1e7, team);
    ASSERT_FALSE(refused);
    EXPECT_EQ(
        refused.error().message,
        "20000 cells would have about 19999 neighbours each: 4e+08 pairs of cells, but there is "
        "memory only for 1e+07");
    EXPECT_TRUE(find_neighbours(cells.view(), {1.2, 0, {}}, 0.1, 1e7, team));
}

/// The estimate of the memory looks at some cells only. In this test, these cells have no
/// neighbours.
TEST(Neighbours, AreRefusedIfTheEstimateMissesThem) {
    RandomStream random(6);
    Cells cells = random_cells(6400, {1, 1, 1}, 1e-6, 1e-6, random);
    for (std::size_t k = 0; k < cells.places.size(); ++k) {
        if (k % 100 != 0) cells.places[k] = {0.5, 0.5, 0.5};
    }
    Team team(2);
    const auto refused = find_neighbours(cells.view(), {1.2, 0, {}}, 0.1, 1e6, team);
    ASSERT_FALSE(refused);
}

TEST(Neighbours, AreNearEachOtherInMemoryAlongACurve) {
    RandomStream random(7);
    const Cells cells = random_cells(20000, {1, 1, 0}, 0.004, 0.004, random);
    const std::vector<std::uint32_t> order = order_along_curve(cells.view());
    Cells ordered;
    std::vector<bool> seen(order.size(), false);
    for (const std::uint32_t cell : order) {
        EXPECT_FALSE(seen[cell]);
        seen[cell] = true;
        ordered.places.push_back(cells.places[cell]);
        ordered.radii.push_back(cells.radii[cell]);
        ordered.ranks.push_back(cells.ranks[cell]);
    }
    Team team(1);
    const auto before = find_neighbours(cells.view(), {}, 0.1, 1e9, team);
    const auto after = find_neighbours(ordered.view(), {}, 0.1, 1e9, team);
    EXPECT_EQ(before->neighbours.size(), after->neighbours.size());
    EXPECT_LT(20 * after->far_links, before->far_links);
}

}  // namespace
}  // namespace cascade::test
