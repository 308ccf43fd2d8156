// Finding values that are not finite.
#include "solvers/finite.h"

#include "tests/support/not_finite.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>
#include <limits>

namespace cascade::test {
namespace {

TEST(Finite, ExtremeNumbersAreFinite) {
    const Grid grid{37, 5, Boundary::periodic};
    Field field = make_field(grid, scatter);
    field.at(3, 1) = std::numeric_limits<float>::max();
    field.at(4, 1) = std::numeric_limits<float>::lowest();
    field.at(5, 1) = std::numeric_limits<float>::denorm_min();
    field.at(6, 1) = -0.0f;
    EXPECT_TRUE(are_finite(field, {0, 5}));
    EXPECT_FALSE(first_not_finite(field));
}

TEST(Finite, EachKindIsFoundInEveryCell) {
    const Grid grid{37, 3, Boundary::periodic};
    for (const float bad : {infinity, -infinity, nan, -nan}) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                Field field = make_field(grid, scatter);
                field.at(i, j) = bad;
                EXPECT_FALSE(are_finite(field, {0, 3}));
                EXPECT_FALSE(are_finite(field, {j, j + 1}));
                EXPECT_TRUE(are_finite(field, {j + 1, 3}));
                EXPECT_TRUE(are_finite(field, {0, j}));
                EXPECT_EQ(first_not_finite(field), (CellPlace{i, j}));
            }
        }
    }
}

TEST(Finite, HaloAndPaddingMayHoldAnything) {
    const Grid grid{17, 2, Boundary::periodic};
    const PlaneLayout layout(grid);
    Field field = make_field(grid, scatter);
    for (std::int64_t j = -1; j <= 2; ++j) {
        const std::int64_t pad = PlaneLayout::row_pad;
        for (std::int64_t i = -pad; i < layout.stride - pad; ++i) {
            const bool is_cell = 0 <= j && j < 2 && 0 <= i && i < 17;
            if (!is_cell) field.at(i, j) = nan;
        }
    }
    EXPECT_TRUE(are_finite(field, {0, 2}));
    EXPECT_FALSE(first_not_finite(field));
}

TEST(Finite, FirstMeansRowOrder) {
    Field field = make_field(Grid{9, 9, Boundary::periodic}, scatter);
    field.at(8, 3) = nan;
    field.at(0, 4) = infinity;
    EXPECT_EQ(first_not_finite(field), (CellPlace{8, 3}));
}

}  // namespace
}  // namespace cascade::test
