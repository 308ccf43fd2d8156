// Reductions over links by the interpreter, compared with loops over the list of links.
#include "core/floating_point.h"
#include "core/links.h"
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "ir/kernel_cost.h"
#include "ir/kernel_parts.h"
#include "ir/loop_levels.h"
#include "tests/support/not_finite.h"
#include "tests/support/random_links.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace cascade {
namespace {

using test::infinity;
using test::nan;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Cells in rows of 40, whose links are those of a list without weights.
class LinkedCells {
public:
    explicit LinkedCells(LinkList list) : list_(std::move(list)) {
        const auto cells = static_cast<std::int64_t>(list_.ends.size());
        grid_.linked = true;
        grid_.width = std::min<std::int64_t>(cells, 40);
        grid_.height = (cells + grid_.width - 1) / grid_.width;
        links_.assign({list_.ends, list_.neighbours}, PlaneLayout(grid_), Precision::single);
    }

    const LinkList& list() const { return list_; }

    /// The results of a kernel with one field, which has these values.
    std::vector<std::vector<float>> run(const CellKernel& kernel,
                                        const std::vector<float>& field) const {
        EXPECT_EQ(verify(kernel), "");
        const PlaneLayout layout(grid_);
        const auto place = [&](std::size_t cell) {
            const auto number = static_cast<std::int64_t>(cell);
            return layout.row_start(number / grid_.width) + number % grid_.width;
        };
        Plane<float> given(layout);
        for (std::size_t k = 0; k < field.size(); ++k) given.origin()[place(k)] = field[k];
        std::vector<Plane<float>> planes;
        std::vector<float*> results;
        for (std::size_t k = 0; k < kernel.results.size(); ++k) {
            results.push_back(planes.emplace_back(layout).origin());
        }
        const float* const fields[] = {given.origin()};
        const KernelPointer compiled = *make_interpreter()->compile(kernel, Stencil::linked);
        const FlushDenormals environment;
        compiled->run({fields, {}, {}, results, layout, links_.table<float>()},
                      {{0, grid_.height}});
        std::vector<std::vector<float>> values(results.size());
        for (std::size_t k = 0; k < results.size(); ++k) {
            for (std::size_t cell = 0; cell < field.size(); ++cell) {
                values[k].push_back(results[k][place(cell)]);
            }
        }
        return values;
    }

    /// `total(cell, begin, end)` for each cell with the range of its neighbours in the list.
    template <typename Total>
    std::vector<float> of_list(const Total& total) const {
        std::vector<float> values;
        for (std::size_t cell = 0; cell < list_.ends.size(); ++cell) {
            const auto begin = list_.neighbours.begin();
            const auto first = static_cast<std::ptrdiff_t>(cell == 0 ? 0 : list_.ends[cell - 1]);
            values.push_back(
                total(cell, begin + first, begin + static_cast<std::ptrdiff_t>(list_.ends[cell])));
        }
        return values;
    }

private:
    LinkList list_;
    Grid grid_;
    Links links_;
};

std::vector<float> random_values(std::size_t count) {
    test::RandomStream random(7);
    std::vector<float> values;
    for (std::size_t k = 0; k < count; ++k) values.push_back(random.symmetric() * 8);
    return values;
}

/// A cell with links to all others.
LinkedCells star(std::size_t neighbours) {
    LinkList list;
    for (std::size_t k = 1; k <= neighbours; ++k) {
        list.neighbours.push_back(static_cast<std::uint32_t>(k));
    }
    list.ends.assign(neighbours + 1, neighbours);
    return LinkedCells(list);
}

class LinkReductions : public ::testing::TestWithParam<std::size_t> {};

TEST_P(LinkReductions, AreThoseOfTheList) {
    const LinkedCells cells(test::random_links(GetParam(), GetParam()));
    const std::vector<float> f = random_values(GetParam());
    KernelBuilder b;
    const FieldSlot slot = b.field_slot("f");
    const ValueId apart = b.subtract(b.theirs(slot), b.field(slot));
    b.result("sum", b.link_sum(b.multiply(apart, apart)));
    b.result("least", b.link_least(apart));
    b.result("greatest", b.link_greatest(apart));
    b.result("count", b.link_sum(b.number(1)));
    const auto results = cells.run(std::move(b).finish(), f);

    EXPECT_EQ(results[0], cells.of_list([&](std::size_t i, auto j, auto end) {
        float sum = 0;
        for (; j != end; ++j) sum += (f[*j] - f[i]) * (f[*j] - f[i]);
        return sum;
    }));
    EXPECT_EQ(results[1], cells.of_list([&](std::size_t i, auto j, auto end) {
        float least = infinity;
        for (; j != end; ++j) least = std::min(least, f[*j] - f[i]);
        return least;
    }));
    EXPECT_EQ(results[2], cells.of_list([&](std::size_t i, auto j, auto end) {
        float greatest = -infinity;
        for (; j != end; ++j) greatest = std::max(greatest, f[*j] - f[i]);
        return greatest;
    }));
    EXPECT_EQ(results[3], cells.of_list([&](std::size_t, auto j, auto end) {
        return static_cast<float>(end - j);
    }));
}

// A mean over links, then the sum of squared differences from it: the second loop needs the result
// of the first, and both read the same field.
TEST_P(LinkReductions, MayNeedEachOther) {
    const LinkedCells cells(test::random_links(GetParam(), GetParam()));
    const std::vector<float> f = random_values(GetParam());
    KernelBuilder b;
    const ValueId theirs = b.theirs(b.field_slot("f"));
    const ValueId mean = b.divide(b.link_sum(theirs), b.link_sum(b.number(1)));
    const ValueId apart = b.subtract(theirs, mean);
    b.result("variance", b.link_sum(b.multiply(apart, apart)));
    b.result("mean", b.multiply(b.field(b.field_slot("f")), mean));
    const CellKernel kernel = std::move(b).finish();
    const CellSchedule schedule = cell_schedule_of(kernel, loop_levels_of(kernel));
    ASSERT_EQ(schedule.loops.size(), 2u);
    EXPECT_EQ(schedule.loops[0].reductions.size(), 2u);
    EXPECT_EQ(schedule.loops[1].before.size(), 1u);
    const auto results = cells.run(kernel, f);
    const auto mean_of = [&](auto j, auto end) {
        float sum = 0, count = 0;
        for (; j != end; ++j, ++count) sum += f[*j];
        return sum / count;
    };
    const auto expected = cells.of_list([&](std::size_t, auto j, auto end) {
        const float of_all = mean_of(j, end);
        float sum = 0;
        for (; j != end; ++j) sum += (f[*j] - of_all) * (f[*j] - of_all);
        return sum;
    });
    EXPECT_EQ(results[0], expected);
    for (std::size_t cell = 0; cell < f.size(); ++cell) {
        const std::size_t first = cell == 0 ? 0 : cells.list().ends[cell - 1];
        const bool has_none = first == cells.list().ends[cell];
        EXPECT_EQ(std::isnan(results[1][cell]), has_none);
    }
}

// With the last size, most offsets of links exceed 16 bits, so many entries are padded with links
// that lead neither to the cell nor to a neighbour.
INSTANTIATE_TEST_SUITE_P(Sizes, LinkReductions,
                         ::testing::Values(1, 15, 16, 39, 40, 41, 103, 640, 700, 40000));

TEST(LinkReduction, OfNoneIsWhatTheyBeginWith) {
    KernelBuilder b;
    const ValueId theirs = b.theirs(b.field_slot("f"));
    b.result("sum", b.link_sum(theirs));
    b.result("least", b.link_least(theirs));
    b.result("greatest", b.link_greatest(theirs));
    b.result("constant", b.link_least(b.number(2)));
    LinkList list;
    list.ends = {0, 0};
    const auto results = LinkedCells(list).run(std::move(b).finish(), {3, nan});
    EXPECT_THAT(results[0], ElementsAre(0, 0));
    EXPECT_FALSE(std::signbit(results[0][0]));
    EXPECT_THAT(results[1], ElementsAre(infinity, infinity));
    EXPECT_THAT(results[2], ElementsAre(-infinity, -infinity));
    EXPECT_THAT(results[3], ElementsAre(infinity, infinity));
}

TEST(LinkReduction, IsNotANumberIfAValueIs) {
    KernelBuilder b;
    const ValueId theirs = b.theirs(b.field_slot("f"));
    b.result("sum", b.link_sum(theirs));
    b.result("least", b.link_least(theirs));
    b.result("greatest", b.link_greatest(theirs));
    const CellKernel kernel = std::move(b).finish();
    const LinkedCells cells = star(3);
    for (std::size_t place = 1; place <= 3; ++place) {
        std::vector<float> f{0, -1, 2, -3};
        f[place] = nan;
        for (const auto& result : cells.run(kernel, f)) EXPECT_TRUE(std::isnan(result[0]));
    }
}

// A link of a cell to itself counts. Padding does not count, although it may also lead to the cell.
TEST(LinkReduction, CountsLinksOfTheListAlone) {
    KernelBuilder b;
    b.field_slot("f");
    b.result("count", b.link_sum(b.number(1)));
    LinkList list;
    list.ends = {1, 3, 3};
    list.neighbours = {0, 2, 0};
    EXPECT_THAT(LinkedCells(list).run(std::move(b).finish(), {0, 0, 0})[0], ElementsAre(1, 2, 0));
}

TEST(LinkReduction, FlushesDenormalValues) {
    KernelBuilder b;
    b.result("least", b.link_least(b.theirs(b.field_slot("f"))));
    const float tiny = -std::numeric_limits<float>::denorm_min();
    const auto results = star(1).run(std::move(b).finish(), {0, tiny});
    EXPECT_EQ(results[0][0], 0);
    EXPECT_TRUE(std::signbit(results[0][0]));
}

// The sum of the first two numbers is denormal. It would be −0 for two neighbours, and 0 for three,
// after 0 is added.
TEST(LinkReduction, ASumIsNeverMinusZero) {
    KernelBuilder b;
    const ValueId theirs = b.theirs(b.field_slot("f"));
    b.result("sum", b.link_sum(theirs));
    const float least = std::numeric_limits<float>::min();
    for (const std::size_t neighbours : {2u, 3u}) {
        const std::vector<float> f{0, least, -1.5f * least, 0};
        const std::span<const float> used(f.data(), neighbours + 1);
        const auto results =
            star(neighbours).run(std::move(KernelBuilder(b)).finish(), {used.begin(), used.end()});
        EXPECT_EQ(results[0][0], 0);
        EXPECT_FALSE(std::signbit(results[0][0]));
    }
}

TEST(LinkLevel, OnlyReductionsLeaveIt) {
    KernelBuilder b;
    const ValueId theirs = b.theirs(b.field_slot("f"));
    const ValueId twice = b.add(theirs, theirs);
    const ValueId sum = b.link_sum(twice);
    b.result("r", b.add(sum, b.link_sum(b.number(1))));
    CellKernel kernel = std::move(b).finish();
    EXPECT_EQ(verify(kernel), "");
    EXPECT_THAT(loop_levels_of(kernel),
                ElementsAre(LoopLevel::link, LoopLevel::link, LoopLevel::cell, LoopLevel::call,
                            LoopLevel::cell, LoopLevel::cell));
    EXPECT_THAT(print(kernel), HasSubstr("%0 = theirs f\n%1 = add %0, %0\n%2 = link_sum %1\n"));
    EXPECT_TRUE(kernel.reads_neighbours(FieldSlot(0)));
    EXPECT_FALSE(sole_results(kernel)[FieldSlot(0)]);
    EXPECT_TRUE(varying(kernel)[ValueId(4)]);
    kernel.results[0] = ValueId(1);
    EXPECT_EQ(verify(kernel), "result 0 is %1, which is of links, not of cells");
}

TEST(LinkCost, CountsWhatIsComputedForEachLink) {
    KernelBuilder b;
    const FieldSlot f = b.field_slot("f");
    const ValueId theirs = b.theirs(f);
    const ValueId apart = b.subtract(theirs, b.field(f));
    b.result("r", b.add(b.link_sum(b.divide(b.number(1), apart)), b.link_least(theirs)));
    const KernelCost cost = cost_of(std::move(b).finish(), Stencil::linked, 6);
    EXPECT_EQ(cost.operations, 6 * 4 + 1);
    EXPECT_EQ(cost.divisions, 6);
    EXPECT_EQ(cost.loads, 6 * 2 + 1);  // Indices of links, neighbours, and the cell.
    EXPECT_EQ(cost.link_bytes, 6 * 4);
}

/// A kernel of sums over links. If `is_shared`, all sums need the same length for each link,
/// otherwise each needs the length for its own field.
CellKernel kernel_of_sums(std::size_t results, bool is_shared) {
    KernelBuilder b;
    const auto length = [&](const std::string& name) {
        const FieldSlot slot = b.field_slot(name);
        const ValueId apart = b.subtract(b.theirs(slot), b.field(slot));
        return b.apply(Op::square_root, b.multiply(apart, apart));
    };
    for (std::size_t k = 0; k < results; ++k) {
        const std::string own = fmt::format("f{}", k);
        const ValueId factor = is_shared ? b.field(b.field_slot(own)) : b.number(2);
        const ValueId sum = b.link_sum(b.multiply(length(is_shared ? "p" : own), factor));
        b.result(own, b.add(b.field(b.field_slot(own)), sum));
    }
    return std::move(b).finish();
}

TEST(LinkParts, DoNotRepeatLoopsOverLinks) {
    EXPECT_EQ(parts_of(kernel_of_sums(16, true)).size(), 1u);
    EXPECT_EQ(parts_of(kernel_of_sums(16, false)).size(), 2u);
}

}  // namespace
}  // namespace cascade
