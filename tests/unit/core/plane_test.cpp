// Layout and halo of planes.
#include "core/plane.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace cascade {
namespace {

struct PlaneCase {
    std::int64_t width, height;
};

class Halo : public ::testing::TestWithParam<PlaneCase> {
protected:
    Grid grid(Boundary boundary) const { return {GetParam().width, GetParam().height, boundary}; }

    /// Cells hold distinct numbers, everything else NaN.
    static Field numbered(const Grid& grid) {
        Field field{PlaneLayout(grid)};
        float* begin = field.origin() - field.layout().offset(0, 0);
        std::fill_n(begin, field.layout().size(), std::numeric_limits<float>::quiet_NaN());
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) field.at(i, j) = number(i, j);
        }
        return field;
    }
    static float number(std::int64_t i, std::int64_t j) {
        return static_cast<float>(1000 * j + i + 1);
    }

    /// All of memory is as the boundary says: halo cells that a stencil reads, and nothing else
    /// written.
    static void expect_filled(const Field& field, const Grid& grid) {
        const auto beyond = [&](std::int64_t i, std::int64_t n) {
            if (grid.boundary == Boundary::periodic) return (i + n) % n;
            return i < 0 ? 0 : (i == n ? n - 1 : i);
        };
        const std::int64_t pad = PlaneLayout::row_pad;
        for (std::int64_t j = -1; j <= grid.height; ++j) {
            for (std::int64_t i = -pad; i < field.layout().stride - pad; ++i) {
                const bool row_inside = 0 <= j && j < grid.height;
                const bool column_inside = 0 <= i && i < grid.width;
                const bool near = -1 <= i && i <= grid.width;
                if ((row_inside && near) || column_inside) {
                    ASSERT_EQ(field.at(i, j), number(beyond(i, grid.width), beyond(j, grid.height)))
                        << "column " << i << ", row " << j;
                } else {
                    ASSERT_TRUE(std::isnan(field.at(i, j))) << "column " << i << ", row " << j;
                }
            }
        }
    }
};

TEST_P(Halo, WholeFill) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
        Field field = numbered(grid(boundary));
        fill_halo(field.origin(), field.layout(), boundary);
        expect_filled(field, grid(boundary));
    }
}

TEST_P(Halo, ColumnsAndRowsMakeTheWhole) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
        Field field = numbered(grid(boundary));
        const std::int64_t middle = grid(boundary).height / 2;
        fill_halo_columns(field.origin(), field.layout(), boundary, middle, grid(boundary).height);
        fill_halo_rows(field.origin(), field.layout(), boundary);
        fill_halo_columns(field.origin(), field.layout(), boundary, 0, middle);
        expect_filled(field, grid(boundary));
    }
}

TEST_P(Halo, PartsOfTheRowsMakeTheWhole) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::no_flux}) {
        Field field = numbered(grid(boundary));
        const std::int64_t height = grid(boundary).height, middle = height / 3;
        fill_halo_from_rows(field.origin(), field.layout(), boundary, middle, height);
        fill_halo_from_rows(field.origin(), field.layout(), boundary, 0, middle);
        expect_filled(field, grid(boundary));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Halo,
                         ::testing::Values(PlaneCase{1, 1}, PlaneCase{2, 2}, PlaneCase{1, 9},
                                           PlaneCase{16, 1}, PlaneCase{15, 4}, PlaneCase{17, 3},
                                           PlaneCase{64, 64}),
                         [](const auto& tested) {
                             return std::to_string(tested.param.width) + "x" +
                                    std::to_string(tested.param.height);
                         });

TEST(PlaneLayout, RowsAreAlignedAndHaveRoomForAVector) {
    for (std::int64_t width = 1; width < 70; ++width) {
        const PlaneLayout layout(Grid{width, 3, Boundary::periodic});
        EXPECT_EQ(layout.stride % PlaneLayout::row_pad, 0);
        EXPECT_EQ(layout.offset(0, 0) % PlaneLayout::row_pad, 0);
        // A vector that starts at any cell ends before the next row's own space.
        EXPECT_LE(layout.offset(width - 1, 0) + PlaneLayout::row_pad, layout.offset(0, 1));
        EXPECT_GE(layout.offset(-1, -1), 0);
        EXPECT_LT(layout.offset(width, 3), layout.size());
    }
}

TEST(Plane, CellsAreAlignedZeroAndMovable) {
    Field field{PlaneLayout(Grid{33, 7, Boundary::periodic})};
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.origin()) % 64, 0u);
    EXPECT_EQ(field.at(32, 6), 0.0f);
    field.at(32, 6) = 5;
    const float* address = field.origin();
    const Field copy = field.clone();
    const Field moved = std::move(field);
    EXPECT_EQ(moved.origin(), address);
    EXPECT_NE(copy.origin(), address);
    EXPECT_EQ(copy.at(32, 6), 5.0f);
    EXPECT_TRUE(field.empty());  // NOLINT: looks at what a move leaves.
    EXPECT_FALSE(moved.empty());
}

}  // namespace
}  // namespace cascade
