// Tables of links without weights equal tables with weights to the bit, also in reused memory.
#include "core/links.h"

#include "core/grid.h"
#include "tests/support/random_links.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cascade {
namespace {

Grid rows_of(std::size_t cells, std::int64_t width) {
    Grid grid;
    grid.linked = true;
    grid.width = width;
    grid.height = (static_cast<std::int64_t>(cells) + width - 1) / width;
    return grid;
}

void expect_same(const Links& a, const Links& b, const PlaneLayout& layout) {
    const LinkTable<float> one = a.table<float>(), other = b.table<float>();
    constexpr std::int64_t lanes = LinkTable<float>::slice_cells;
    const std::int64_t slices = (layout.width + lanes - 1) / lanes * layout.height;
    ASSERT_TRUE(std::equal(one.starts, one.starts + slices + 1, other.starts));
    const std::int64_t entries = one.starts[slices];
    EXPECT_TRUE(std::equal(one.bases, one.bases + entries, other.bases));
    EXPECT_TRUE(std::equal(one.filled, one.filled + entries, other.filled));
    EXPECT_TRUE(std::equal(one.offsets, one.offsets + lanes * entries, other.offsets));
    EXPECT_EQ(one.reach, other.reach);
}

TEST(Links, WithoutWeightsAreThoseWithThem) {
    Links placed;  // This memory is used again for lists of different sizes.
    for (const std::size_t cells : {1u, 15u, 16u, 103u, 40000u, 640u, 700u}) {
        for (const std::int64_t width : {1, 24, 40, 512}) {
            SCOPED_TRACE(::testing::Message() << cells << " cells in rows of " << width);
            const PlaneLayout layout(rows_of(cells, width));
            const LinkList list = test::random_links(cells, cells);
            placed.assign({list.ends, list.neighbours}, layout, Precision::single);
            expect_same(placed, Links(list, layout, Precision::single), layout);
            EXPECT_EQ(placed.table<float>().weights, nullptr);
            EXPECT_EQ(placed.precision(), Precision::single);
        }
    }
}

TEST(Links, AreMadeAnewInTheirMemoryUnlessItIsShared) {
    const PlaneLayout layout(rows_of(700, 40));
    const LinkList first = test::random_links(700, 1), second = test::random_links(600, 2);
    Links links;
    links.assign({first.ends, first.neighbours}, layout, Precision::single);
    const std::int16_t* const memory = links.table<float>().offsets;
    const std::vector<std::size_t> fewer(first.ends.begin(), first.ends.begin() + 650);
    links.assign({fewer, first.neighbours}, layout, Precision::binary64);
    EXPECT_EQ(links.precision(), Precision::binary64);
    EXPECT_EQ(links.table<double>().offsets, memory);

    links.assign({first.ends, first.neighbours}, layout, Precision::single);
    const Links copy = links;
    links.assign({second.ends, second.neighbours}, layout, Precision::single);
    EXPECT_NE(links.table<float>().offsets, copy.table<float>().offsets);
    expect_same(copy, Links(first, layout, Precision::single), layout);
}

TEST(Links, AreTheSameWhereMostSlicesAreCopied) {
    const PlaneLayout layout(rows_of(700, 40));
    LinkList list = test::random_links(700, 4);
    Links links;
    links.assign({list.ends, list.neighbours}, layout, Precision::single);
    // Cells lose their last link, and cells after them are added and removed.
    std::vector<std::size_t> counts{700};
    for (const std::size_t count : {700U, 690U, 695U, 650U, 700U}) {
        std::vector<bool> changed(count, false);
        for (const std::size_t cell : {3U, 100U, 101U, 400U, 649U}) {
            const std::size_t begin = list.ends[cell - 1];
            if (list.ends[cell] - begin < 2) continue;
            list.neighbours.erase(list.neighbours.begin() + static_cast<std::ptrdiff_t>(begin));
            for (std::size_t k = cell; k < list.ends.size(); ++k) --list.ends[k];
            changed[cell] = true;
        }
        for (std::size_t cell = counts.back(); cell < count; ++cell) changed[cell] = true;
        counts.push_back(count);
        const std::vector<std::size_t> ends(list.ends.begin(),
                                            list.ends.begin() + static_cast<std::ptrdiff_t>(count));
        links.assign({ends, list.neighbours}, layout, Precision::single, changed);
        Links whole;
        whole.assign({ends, list.neighbours}, layout, Precision::single);
        const auto table = links.table<float>(), expected = whole.table<float>();
        const auto slices = static_cast<std::ptrdiff_t>(3 * layout.height);
        ASSERT_TRUE(std::equal(table.starts, table.starts + slices + 1, expected.starts));
        const std::ptrdiff_t entries = table.starts[slices];
        EXPECT_TRUE(std::equal(table.bases, table.bases + entries, expected.bases));
        EXPECT_TRUE(std::equal(table.filled, table.filled + entries, expected.filled));
        EXPECT_TRUE(std::equal(table.offsets, table.offsets + 16 * entries, expected.offsets));
        EXPECT_GE(table.reach, expected.reach);
    }
}

// Lane 0 has a near neighbour in its second entry, lane 1 in its first.
TEST(Links, SayWhichLanesOfAnEntryAreFilled) {
    const PlaneLayout layout(rows_of(3, 3));
    const std::size_t ends[] = {2, 3, 3};
    const std::uint32_t neighbours[] = {1, 2, 0};
    Links links;
    links.assign({ends, neighbours}, layout, Precision::single);
    const LinkTable<float> table = links.table<float>();
    ASSERT_EQ(table.starts[1], 2u);
    EXPECT_EQ(table.filled[0], 3);
    EXPECT_EQ(table.filled[1], 1);
    EXPECT_EQ(table.target(LinkTable<float>::slice_cells), 2);
}

}  // namespace
}  // namespace cascade
