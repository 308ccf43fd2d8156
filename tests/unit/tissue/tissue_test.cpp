// Cells keep their values when they move in memory.
#include "tissue/tissue.h"

#include <bit>
#include <gtest/gtest.h>
#include <numeric>

namespace cascade::test {
namespace {

/// Cells with two species that contain the cell's number.
TissueRecord numbered(std::size_t count) {
    TissueRecord record;
    record.species.resize(2);
    record.stiffest.resize(2);
    for (std::size_t k = 0; k < count; ++k) {
        const auto number = static_cast<std::uint32_t>(3 * k + 1);
        record.numbers.push_back(number);
        record.triangles.push_back(number + 7);
        for (std::size_t s = 0; s < 2; ++s) {
            record.species[s].push_back(number + 0.5 * static_cast<double>(s));
            record.stiffest[s].push_back(-1.0 * number);
        }
    }
    record.next_number = static_cast<std::uint32_t>(3 * count + 1);
    record.births = 5;
    record.time.t = 0.1;
    return record;
}

void expect_equal(const TissueRecord& a, const TissueRecord& b) {
    EXPECT_EQ(a.numbers, b.numbers);
    EXPECT_EQ(a.species, b.species);
    EXPECT_EQ(a.stiffest, b.stiffest);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.next_number, b.next_number);
    EXPECT_EQ(a.births, b.births);
    EXPECT_EQ(a.time.t, b.time.t);
}

TEST(Tissue, IsRecordedInTheOrderOfBirth) {
    for (const std::size_t count : {1, 6, 15, 16, 17, 400, 5000}) {
        const TissueRecord record = numbered(count);
        Tissue tissue(record, Precision::single);
        expect_equal(tissue.record(), record);
        std::vector<std::uint32_t> turned(count);
        std::iota(turned.rbegin(), turned.rend(), std::uint32_t{0});
        EXPECT_FALSE(tissue.rearrange(turned));
        EXPECT_EQ(tissue.numbers().front(), record.numbers.back());
        EXPECT_EQ(tissue.by_number()[0], count - 1);
        expect_equal(tissue.record(), record);
    }
}

TEST(Tissue, GivesNewCellsTheNextNumbers) {
    Tissue tissue(numbered(4), Precision::binary64);
    const double* const plane = tissue.species[0].origin<double>();
    // The second cell dies, the third divides.
    const std::vector<std::uint32_t> sources{0, 2, 3, 2}, born{3};
    EXPECT_FALSE(tissue.rearrange(sources, born));
    EXPECT_EQ(tissue.species[0].origin<double>(), plane);
    EXPECT_EQ(tissue.record().numbers, (std::vector<std::uint32_t>{1, 7, 10, 13}));
    EXPECT_EQ(tissue.record().species[1], (std::vector<double>{1.5, 7.5, 10.5, 7.5}));
    EXPECT_EQ(tissue.record().triangles, (std::vector<std::uint32_t>{8, 14, 17, 14}));
    EXPECT_EQ(tissue.next_number, 14U);
}

TEST(Tissue, GrowsAndShrinksWithFewMoves) {
    Tissue tissue(numbered(1), Precision::single);
    int moves = 0;
    while (tissue.count() < 10000) {
        std::vector<std::uint32_t> sources(tissue.count() + 1);
        std::iota(sources.begin(), sources.end() - 1, std::uint32_t{0});
        const std::vector<std::uint32_t> born{static_cast<std::uint32_t>(tissue.count())};
        moves += tissue.rearrange(sources, born) ? 1 : 0;
        ASSERT_LE(tissue.count(), static_cast<std::size_t>(tissue.grid().cell_count()));
    }
    EXPECT_LT(moves, 70);
    EXPECT_LT(tissue.grid().cell_count(), 11500);
    const std::vector<std::uint32_t> few{9, 17};
    EXPECT_TRUE(tissue.rearrange(few));
    EXPECT_EQ(tissue.grid().cell_count(), 16);
}

TEST(Tissue, RepeatsTheLastCellToTheEndOfItsPlanes) {
    Tissue tissue(numbered(19), Precision::single);
    const std::int64_t places = tissue.grid().cell_count();
    ASSERT_GT(places, 19);
    const auto last = static_cast<std::size_t>(places - 1);
    EXPECT_EQ(tissue.value(0, last), tissue.value(0, 18));
    tissue.set(0, 18, -3);
    tissue.pad();
    EXPECT_EQ(tissue.value(0, last), -3);
    EXPECT_EQ(tissue.inside().origin()[tissue.element(18)], 1);
    EXPECT_EQ(tissue.inside().origin()[tissue.element(19)], 0);
    const float word = tissue.number_plane().origin()[tissue.element(18)];
    EXPECT_EQ(std::bit_cast<std::uint32_t>(word), tissue.numbers()[18]);
}

TEST(Tissue, MayDieOut) {
    Tissue tissue(numbered(3), Precision::single);
    tissue.rearrange({});
    EXPECT_EQ(tissue.count(), 0U);
    EXPECT_TRUE(tissue.record().numbers.empty());
}

}  // namespace
}  // namespace cascade::test
