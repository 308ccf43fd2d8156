// Layout and halo of planes.
#include "core/plane.h"

#include "core/side_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace cascade {
namespace {

constexpr Boundary either[] = {Boundary::periodic, Boundary::no_flux};

float number(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<float>(100000 * k + 1000 * j + i + 1);
}

/// Cells contain distinct numbers, and all other memory NaN.
Field numbered(const Grid& grid) {
    Field field{PlaneLayout(grid)};
    float* begin = field.origin() - field.layout().offset(0, 0);
    std::fill_n(begin, field.layout().size(), std::numeric_limits<float>::quiet_NaN());
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) field.at(i, j, k) = number(i, j, k);
        }
    }
    return field;
}

/// The cell whose value the boundary puts at index i of an axis of n cells, where −1 ≤ i ≤ n.
std::int64_t beyond(Boundary boundary, std::int64_t i, std::int64_t n) {
    if (boundary == Boundary::periodic) return (i + n) % n;
    return i < 0 ? 0 : (i == n ? n - 1 : i);
}

/// Expects that the halo with its edges and corners is filled by the boundary, and that nothing
/// else is written. With `has_rows`, the rows above and below the cells are filled, too.
void expect_filled(const Field& field, const Grid& grid, bool has_rows = true) {
    const std::int64_t pad = PlaneLayout::row_pad;
    const std::int64_t halo = grid.depth > 1 ? 1 : 0;
    for (std::int64_t k = -halo; k < grid.depth + halo; ++k) {
        for (std::int64_t j = -1; j <= grid.height; ++j) {
            for (std::int64_t i = -pad; i < field.layout().stride - pad; ++i) {
                const bool is_filled = has_rows || (0 <= j && j < grid.height);
                if (is_filled && -1 <= i && i <= grid.width) {
                    ASSERT_EQ(field.at(i, j, k), number(beyond(grid.boundary.x, i, grid.width),
                                                        beyond(grid.boundary.y, j, grid.height),
                                                        beyond(grid.boundary.z, k, grid.depth)))
                        << "column " << i << ", row " << j << ", slice " << k;
                } else {
                    ASSERT_TRUE(std::isnan(field.at(i, j, k)))
                        << "column " << i << ", row " << j << ", slice " << k;
                }
            }
        }
    }
}

struct PlaneCase {
    std::int64_t width, height, depth = 1;
};

class Halo : public ::testing::TestWithParam<PlaneCase> {
protected:
    /// The grid with every combination of boundaries.
    static std::vector<Grid> grids() {
        std::vector<Grid> all;
        for (const Boundary x : either) {
            for (const Boundary y : either) {
                for (const Boundary z : either) {
                    all.push_back(
                        {GetParam().width, GetParam().height, {x, y, z}, GetParam().depth});
                }
            }
        }
        return all;
    }
};

TEST_P(Halo, WholeFill) {
    for (const Grid& grid : grids()) {
        Field field = numbered(grid);
        fill_halo(field.origin(), field.layout(), grid.boundary);
        expect_filled(field, grid);
    }
}

TEST_P(Halo, PartsOfTheCellsMakeTheWhole) {
    for (const Grid& grid : grids()) {
        Field field = numbered(grid);
        const std::int64_t rows = field.layout().row_count(), middle = (rows + 1) / 3;
        const std::int64_t column = (grid.width + 1) / 2;
        const auto part = [&](std::int64_t begin, std::int64_t end) {
            for (const ColumnRange columns : {ColumnRange{column}, ColumnRange{0, column}}) {
                fill_halo_from(field.origin(), field.layout(), grid.boundary,
                               {{begin, end}, columns});
            }
        };
        part(middle, rows);
        part(middle, middle);
        part(0, middle);
        expect_filled(field, grid, grid.height > 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Halo,
                         ::testing::Values(PlaneCase{1, 1}, PlaneCase{2, 2}, PlaneCase{1, 9},
                                           PlaneCase{16, 1}, PlaneCase{15, 4}, PlaneCase{17, 3},
                                           PlaneCase{64, 64}, PlaneCase{5, 4, 3},
                                           PlaneCase{1, 1, 2}, PlaneCase{16, 1, 5},
                                           PlaneCase{1, 3, 2}, PlaneCase{17, 9, 6}),
                         [](const auto& tested) {
                             return std::to_string(tested.param.width) + "x" +
                                    std::to_string(tested.param.height) + "x" +
                                    std::to_string(tested.param.depth);
                         });

/// The value at a position of the halo by definition: x first, then y, then z.
float expected_beyond(const Field& cells, const Grid& grid, const SideRules& sides,
                      const Field& values, std::array<std::int64_t, 3> at) {
    const std::int64_t counts[3] = {grid.width, grid.height, grid.depth};
    for (std::size_t axis = 3; axis-- > 0;) {
        if (0 <= at[axis] && at[axis] < counts[axis]) continue;
        const SideRule& rule = sides.at[2 * axis + (at[axis] < 0 ? 0 : 1)];
        std::array<std::int64_t, 3> inside = at;
        const bool is_periodic = rule.kind == SideKind::periodic;
        inside[axis] =
            beyond(is_periodic ? Boundary::periodic : Boundary::no_flux, at[axis], counts[axis]);
        const float cell = expected_beyond(cells, grid, sides, values, inside);
        const float value = rule.values ? values.at(inside[0], inside[1], inside[2])
                                        : static_cast<float>(rule.value);
        if (rule.kind == SideKind::fixed) return 2 * value - cell;
        return rule.kind == SideKind::slope ? cell + static_cast<float>(sides.spacing) * value
                                            : cell;
    }
    return cells.at(at[0], at[1], at[2]);
}

/// The values of a side that are needed for the halo of these rows.
std::shared_ptr<const SideValues> values_beside(const Field& values, Side side, RowRange rows) {
    const SideCells cells = SideCells::of_rows(values.layout(), side, rows);
    SideValues part{cells.first, {}};
    for (std::int64_t cell = cells.first; cell < cells.first + cells.count; ++cell) {
        part.numbers.push_back(values.origin()[SideCells::offset(values.layout(), side, cell)]);
    }
    return std::make_shared<const SideValues>(part);
}

TEST_P(Halo, SidesWithValues) {
    const Grid grid{GetParam().width, GetParam().height, Boundary::no_flux, GetParam().depth};
    const Field values = numbered(grid);
    const std::int64_t rows = values.layout().row_count();
    const SideKind kinds[] = {SideKind::no_flux, SideKind::fixed, SideKind::slope};
    for (int mixture = 0; mixture < 729; mixture += 7) {
        SideRules sides;
        sides.spacing = 0.5f;
        int digits = mixture;
        for (std::size_t side = 0; side < side_count; ++side, digits /= 3) {
            sides.at[side] = {kinds[digits % 3], static_cast<float>(side) + 0.25f, nullptr};
        }
        const bool wraps = mixture % 3 == 1;
        if (wraps) sides.at[0].kind = sides.at[1].kind = SideKind::periodic;
        // Beyond the ends of a side its values continue like the field.
        values.fill_halo(Boundaries(wraps ? Boundary::periodic : Boundary::no_flux,
                                    Boundary::no_flux, Boundary::no_flux));
        Field field = numbered(grid);
        for (const RowRange part : {RowRange{rows / 2, rows}, RowRange{0, rows / 2}}) {
            for (std::size_t side = 0; side < side_count; ++side) {
                if ((mixture + static_cast<int>(side)) % 2 != 0) continue;
                sides.at[side].values = values_beside(values, static_cast<Side>(side), part);
            }
            for (const ColumnRange columns : {ColumnRange{0, 1}, ColumnRange{1}}) {
                fill_halo_from(field.origin(), field.layout(), sides, {part, columns});
            }
        }
        const std::int64_t halo = grid.depth > 1 ? 1 : 0, halo_rows = grid.height > 1 ? 1 : 0;
        for (std::int64_t k = -halo; k < grid.depth + halo; ++k) {
            for (std::int64_t j = -halo_rows; j < grid.height + halo_rows; ++j) {
                for (std::int64_t i = -1; i <= grid.width; ++i) {
                    ASSERT_EQ(field.at(i, j, k),
                              expected_beyond(field, grid, sides, values, {i, j, k}))
                        << mixture << ": " << i << " " << j << " " << k;
                }
            }
        }
    }
}

TEST(PlaneLayout, RowsGoThroughAllSlices) {
    Field field = numbered(Grid{5, 4, {}, 3});
    for (std::int64_t row = 0; row < 12; ++row) {
        EXPECT_EQ(field.row(row)[2], number(2, row % 4, row / 4)) << row;
    }
    EXPECT_EQ(PlaneLayout(Grid{5, 4}).size(), 6 * PlaneLayout(Grid{5, 4}).stride)
        << "a plane has no halo slices";
}

TEST(PlaneLayout, RowsAreAlignedAndHaveRoomForAVector) {
    for (std::int64_t width = 1; width < 70; ++width) {
        const PlaneLayout layout(Grid{width, 3, Boundary::periodic});
        EXPECT_EQ(layout.stride % PlaneLayout::row_pad, 0);
        EXPECT_EQ(layout.offset(0, 0) % PlaneLayout::row_pad, 0);
        // A vector that starts at any cell ends before the cells of the next row.
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
    EXPECT_TRUE(field.empty());  // NOLINT: checks a moved-from object.
    EXPECT_FALSE(moved.empty());
}

TEST(Plane, WhatOwnsPlanesMayBeCopied) {
    std::vector<Field> fields(2);
    fields[1] = Field(PlaneLayout(Grid{5, 3}), Precision::binary64);
    fields[1].at<double>(4, 2) = 7;
    const std::vector<Field> copies(fields);
    fields[1].at<double>(4, 2) = 8;
    EXPECT_TRUE(copies[0].empty());
    EXPECT_EQ(copies[1].at<double>(4, 2), 7.0);
}

TEST(Plane, ItsHaloIsNoPartOfItsValue) {
    const Field field = numbered(Grid{3, 2});
    field.fill_halo(Boundaries(Boundary::no_flux));
    EXPECT_EQ(field.at(-1, 0), field.at(0, 0));
    field.fill_halo(Boundaries(Boundary::periodic));
    EXPECT_EQ(field.at(-1, 0), field.at(2, 0));
}

}  // namespace
}  // namespace cascade
