// Lists of neighbours that are updated for some cells, compared with a search of all pairs.
#include "tissue/kept_lists.h"

#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cascade::test {
namespace {

constexpr double usual_radius = 0.02, many = 1e9;
constexpr float usual_skin = 0.3F;

/// Cells on a square, and the marks (places at the last search) with which their neighbours were
/// found.
class MovingCells {
public:
    explicit MovingCells(const NeighbourRule& rule, std::size_t count = 400) : rule_(rule) {
        for (std::size_t k = 0; k < count; ++k) add(random_place());
        std::vector<float> skins(count, usual_skin);
        const CellPlaces cells{places_, radii_, ranks_, skins};
        for (std::uint32_t k = 0; k < count; ++k)
            marks_.push_back(boxed(cells, k, rule_, usual_skin));
        NeighbourSearch search(cells, rule_, 0);
        Team team(1);
        auto found = find_neighbours(search, ranks_, many, team);
        lists_.start(std::move(*found), std::move(search));
    }

    void add(Vector3d place, double size = usual_radius) {
        ranks_.push_back(static_cast<std::uint32_t>(places_.size()));
        places_.push_back(place);
        radii_.push_back(size);
    }
    void move(std::uint32_t cell) { places_[cell] = random_place(); }
    /// The last cell takes the element of the cell that dies.
    void kill(std::uint32_t cell) {
        const std::uint32_t rank = ranks_[cell];
        places_[cell] = places_.back();
        radii_[cell] = radii_.back();
        ranks_[cell] = ranks_.back();
        places_.pop_back();
        radii_.pop_back();
        ranks_.pop_back();
        for (std::uint32_t& other : ranks_) other -= other > rank ? 1 : 0;
    }
    Vector3d random_place() {
        return {static_cast<double>(random_.symmetric()) / 2 + 0.5,
                static_cast<double>(random_.symmetric()) / 2 + 0.5, 0};
    }
    std::uint32_t any_cell() { return random_.below(places_.size()); }
    std::size_t count() const { return places_.size(); }

    bool renew(const std::vector<std::uint32_t>& cells, double most_links = many) {
        std::vector<BoxedCell> renewed;
        for (const std::uint32_t cell : cells) {
            renewed.push_back(boxed({places_, radii_, ranks_, {}}, cell, rule_, usual_skin));
        }
        if (!lists_.renew(renewed, ranks_, most_links)) return false;
        marks_.resize(places_.size());
        for (const BoxedCell& cell : renewed) marks_[cell.cell] = cell;
        return true;
    }

    void expect_all_pairs() const {
        NeighbourLists expected;
        for (const BoxedCell& own : marks_) {
            for (const BoxedCell& other : marks_) {
                const double limit =
                    std::max(own.reach + other.reach, rule_.near) + own.slack + other.slack;
                if (own.cell != other.cell && apart(own.place, other.place) < limit) {
                    expected.neighbours.push_back(other.cell);
                    expected.far_links += is_far_link(own.cell, other.cell) ? 1 : 0;
                }
            }
            const std::size_t begin = expected.ends.empty() ? 0 : expected.ends.back();
            std::sort(expected.neighbours.begin() + static_cast<std::ptrdiff_t>(begin),
                      expected.neighbours.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ranks_[a] < ranks_[b]; });
            expected.ends.push_back(expected.neighbours.size());
        }
        EXPECT_EQ(lists_.lists().ends, expected.ends);
        EXPECT_EQ(lists_.lists().neighbours, expected.neighbours);
        EXPECT_EQ(lists_.lists().far_links, expected.far_links);
    }

private:
    double apart(Vector3d a, Vector3d b) const {
        const auto along = [&](double way, double period) {
            return period > 0 ? std::remainder(way, period) : way;
        };
        return std::hypot(along(b.x - a.x, rule_.period[0]), along(b.y - a.y, rule_.period[1]));
    }

    NeighbourRule rule_;
    RandomStream random_{3};
    std::vector<Vector3d> places_;
    std::vector<double> radii_;
    std::vector<std::uint32_t> ranks_;
    std::vector<BoxedCell> marks_;
    KeptLists lists_;
};

TEST(KeptLists, HoldAllPairsOfCellsThatMoveAndAreBorn) {
    for (const double period : {0.0, 1.0}) {
        NeighbourRule rule;
        rule.period = {period, 0, 0};
        MovingCells cells(rule);
        for (int round = 0; round < 6; ++round) {
            std::vector<std::uint32_t> renewed;
            for (int k = 0; k < 5; ++k) {
                const std::uint32_t cell = cells.any_cell();
                if (std::ranges::count(renewed, cell) > 0) continue;
                cells.move(cell);
                renewed.push_back(cell);
            }
            renewed.push_back(static_cast<std::uint32_t>(cells.count()));
            cells.add(cells.random_place());
            ASSERT_TRUE(cells.renew(renewed));
            cells.expect_all_pairs();
        }
    }
}

TEST(KeptLists, HoldAllPairsWhereCellsDie) {
    MovingCells cells({});
    for (int round = 0; round < 8; ++round) {
        std::vector<std::uint32_t> renewed;
        // More cells die than are born, and a freed element is used again two rounds later.
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t cell = cells.any_cell();
            cells.kill(cell);
            renewed.push_back(cell);
        }
        if (round % 2 == 1) {
            for (int k = 0; k < 4; ++k) {
                renewed.push_back(static_cast<std::uint32_t>(cells.count()));
                cells.add(cells.random_place());
            }
        }
        std::sort(renewed.begin(), renewed.end());
        renewed.erase(std::unique(renewed.begin(), renewed.end()), renewed.end());
        std::erase_if(renewed, [&](std::uint32_t cell) { return cell >= cells.count(); });
        ASSERT_TRUE(cells.renew(renewed));
        cells.expect_all_pairs();
    }
}

TEST(KeptLists, FindCellsOutsideOfAllBoxes) {
    MovingCells cells({});
    const auto first = static_cast<std::uint32_t>(cells.count());
    cells.add({1.02, 0.5, 0.01});
    cells.add({-3, 7, 2});
    cells.add({-3, 7.01, 2});
    ASSERT_TRUE(cells.renew({first, first + 1, first + 2}));
    cells.expect_all_pairs();
}

TEST(KeptLists, AreNotKeptWhereAllCellsAreBetterFound) {
    MovingCells cells({});
    std::vector<std::uint32_t> many_cells;
    for (std::uint32_t k = 0; k < 100; ++k) many_cells.push_back(k);
    EXPECT_FALSE(cells.renew(many_cells));
    EXPECT_FALSE(cells.renew({1}, 1000)) << "too many links";
    cells.expect_all_pairs();
    cells.add({0.5, 0.5, 0}, 2 * usual_radius);
    EXPECT_FALSE(cells.renew({400})) << "wider than the boxes";
}

}  // namespace
}  // namespace cascade::test
