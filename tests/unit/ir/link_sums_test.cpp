// Sums over the links of cells by the interpreter, compared with sums over the list of links.
#include "core/links.h"
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "tests/support/random_links.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

#include <array>

namespace cascade {
namespace {

constexpr std::array sums{Op::laplacian,  Op::link_squares, Op::link_flow,    Op::gradient_x,
                          Op::gradient_y, Op::gradient_z,   Op::link_weighted};

CellKernel kernel_of_sums() {
    KernelBuilder builder;
    const FieldSlot f = builder.field_slot("f"), s = builder.field_slot("s"),
                    w = builder.field_slot("w");
    for (const Op op : sums) {
        builder.result(std::string(info(op).name), op == Op::link_flow ? builder.link_flow({s, f})
                                                   : op == Op::link_weighted
                                                       ? builder.link_weighted({w, f})
                                                       : builder.over_links(op, f));
    }
    return std::move(builder).finish();
}

class LinkSums : public ::testing::TestWithParam<std::size_t> {};

TEST_P(LinkSums, AreThoseOfTheList) {
    const std::size_t cells = GetParam();
    Grid grid;
    grid.linked = true;
    grid.width = std::min<std::int64_t>(static_cast<std::int64_t>(cells), 40);
    grid.height = (static_cast<std::int64_t>(cells) + grid.width - 1) / grid.width;
    const PlaneLayout layout(grid);
    const LinkList list = test::random_links(cells, cells);
    const Links links(list, layout, Precision::single);

    test::RandomStream random(7);
    Plane<float> f(layout), s(layout);
    const auto place = [&](std::size_t cell) {
        const auto number = static_cast<std::int64_t>(cell);
        return layout.row_start(number / grid.width) + number % grid.width;
    };
    for (std::size_t cell = 0; cell < cells; ++cell) {
        f.origin()[place(cell)] = static_cast<float>(random.below(1000)) / 100;
        s.origin()[place(cell)] = static_cast<float>(random.below(1000)) / 100;
    }
    std::vector<Plane<float>> results;
    std::vector<float*> addresses;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        addresses.push_back(results.emplace_back(layout).origin());
    }
    std::vector<double> numbers;
    for (std::size_t k = 0; k < list.neighbours.size(); ++k)
        numbers.push_back(static_cast<double>(random.below(1000)) / 100 - 5);
    const Field weights = links.numbers_of(numbers, list.ends, layout);
    const std::array<const float*, 3> fields{f.origin(), s.origin(), weights.origin()};
    const KernelPointer kernel = *make_interpreter()->compile(kernel_of_sums(), Stencil::linked);
    kernel->run({fields, {}, {}, addresses, layout, links.table<float>()}, {0, grid.height});

    for (std::size_t cell = 0; cell < cells; ++cell) {
        const float fi = f.origin()[place(cell)], si = s.origin()[place(cell)];
        std::array<float, sums.size()> expected{};
        for (std::size_t k = cell == 0 ? 0 : list.ends[cell - 1]; k < list.ends[cell]; ++k) {
            const std::int64_t j = place(list.neighbours[k]);
            const float difference = f.origin()[j] - fi;
            const auto w = static_cast<float>(list.weights[k]);
            expected[0] += w * difference;
            expected[1] += w * (difference * difference);
            expected[2] += w * ((s.origin()[j] + si) * difference);
            expected[3] += static_cast<float>(list.gradients[k].x) * difference;
            expected[4] += static_cast<float>(list.gradients[k].y) * difference;
            expected[5] += static_cast<float>(list.gradients[k].z) * difference;
            expected[6] += static_cast<float>(numbers[k]) * difference;
        }
        for (std::size_t k = 0; k < sums.size(); ++k) {
            EXPECT_EQ(addresses[k][place(cell)], expected[k]) << info(sums[k]).name << cell;
        }
    }
}

// With the last size, most offsets of links exceed 16 bits.
INSTANTIATE_TEST_SUITE_P(Sizes, LinkSums,
                         ::testing::Values(1, 15, 16, 39, 40, 41, 103, 640, 700, 40000));

TEST(Links, FillTheLastRowWithCellsLikeTheLast) {
    Grid grid;
    grid.linked = true;
    grid.width = 4;
    grid.height = 2;
    const PlaneLayout layout(grid);
    LinkList list;
    list.ends = {1, 2, 3, 4, 6};
    list.neighbours = {1, 0, 4, 4, 2, 3};
    list.weights = {1, 1, 2, 3, 2, 3};
    const Links links(list, layout, Precision::binary64);
    const LinkTable<double> table = links.table<double>();
    // Slice 1 is the second row, whose cell 0 is cell 4. Later rows are similar.
    ASSERT_EQ(table.starts[2] - table.starts[1], 2U);
    for (std::int64_t lane = 0; lane < 4; ++lane) {
        const std::int64_t link = table.starts[1] * LinkTable<double>::slice_cells + lane;
        EXPECT_EQ(table.target(link), 2);
        EXPECT_EQ(table.target(link + LinkTable<double>::slice_cells), 3);
        EXPECT_EQ(table.weights[link], 2);
    }
    EXPECT_EQ(table.gradients[0], nullptr);
}

}  // namespace
}  // namespace cascade
