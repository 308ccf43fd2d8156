// Norms of fields count only the cells inside a mask.
#include "solvers/chequerboard.h"
#include "solvers/field_norms.h"
#include "solvers/step_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cascade {
namespace {

constexpr std::int64_t plane_side = 12;

/// A mask with the left half inside. Values outside are 0.
Mask left_half() {
    Mask mask{PlaneLayout(Grid{plane_side, plane_side})};
    for (std::int64_t j = 0; j < plane_side; ++j) {
        for (std::int64_t i = 0; i < plane_side / 2; ++i) mask.at(i, j) = 1;
    }
    return mask;
}

template <typename Value>
Field field_of(std::int64_t width, Value value) {
    Field field{PlaneLayout(Grid{width, plane_side})};
    for (std::int64_t j = 0; j < plane_side; ++j) {
        for (std::int64_t i = 0; i < width; ++i) field.at(i, j) = value(i, j);
    }
    return field;
}

float pattern(std::int64_t i, std::int64_t j) {
    return 5 + std::sin(0.7F * static_cast<float>(i + j));
}

TEST(MaskedNorms, AreThoseOfASmallField) {
    const Mask inside = left_half();
    const Field small = field_of(plane_side / 2, pattern);
    const Field large = field_of(plane_side, [](std::int64_t i, std::int64_t j) {
        return i < plane_side / 2 ? pattern(i, j) : 0.0F;
    });
    const FieldMoments expected = moments(small), found = moments(large, &inside);
    EXPECT_DOUBLE_EQ(found.mean, expected.mean);
    EXPECT_DOUBLE_EQ(found.root_mean_square, expected.root_mean_square);
    EXPECT_DOUBLE_EQ(found.deviation, expected.deviation);
    EXPECT_GT(std::abs(moments(large).mean - expected.mean), 1);
}

TEST(MaskedNorms, ChangesAreThoseOfASmallField) {
    const Mask inside = left_half();
    const auto at = [](float amplitude, std::int64_t width) {
        return field_of(width, [&](std::int64_t i, std::int64_t j) {
            return i < plane_side / 2 ? amplitude * pattern(i, j) : 0.0F;
        });
    };
    const FieldMoments found =
        moments_of_difference(at(1.5F, plane_side), at(1, plane_side), &inside);
    const FieldMoments expected =
        moments_of_difference(at(1.5F, plane_side / 2), at(1, plane_side / 2));
    EXPECT_DOUBLE_EQ(found.root_mean_square, expected.root_mean_square);
    EXPECT_DOUBLE_EQ(found.deviation, expected.deviation);
}

/// Copies that fill up the last row of linked cells do not count.
TEST(MaskedNorms, OfALinkedGridCellsAloneCount) {
    StepProblem problem;
    problem.grid = Grid{32, 3};
    problem.grid.linked = true;
    problem.cells_inside = 69;
    Field field{PlaneLayout(problem.grid)};
    Mask inside{PlaneLayout(problem.grid)};
    std::vector<double> rows;
    for (std::int64_t j = 0; j < 3; ++j) {
        for (std::int64_t i = 0; i < 32; ++i) {
            const bool is_cell = 32 * j + i < 69;
            field.at(i, j) = is_cell ? pattern(i, j) : 1e6F;
            inside.at(i, j) = is_cell ? 1 : 0;
        }
        rows.push_back(sum_of_squares(field, j, problem.counted_in_row(j)));
    }
    EXPECT_EQ(problem.counted_in_row(2), 5);
    EXPECT_EQ(root_mean_square(rows, problem.counted_cells()), root_mean_square(field, &inside));
}

TEST(MaskedNorms, AChequerboardIsLookedForInside) {
    const Mask inside = left_half();
    const auto alternating = [](std::int64_t i, std::int64_t j) {
        return 3 + ((i + j) % 2 == 0 ? 0.1F : -0.1F);
    };
    const Field there = field_of(plane_side, [&](std::int64_t i, std::int64_t j) {
        return i < plane_side / 2 ? alternating(i, j) : 0.0F;
    });
    EXPECT_GT(alternating_part(there, &inside), 0.99);
    const Field smooth = field_of(plane_side, [&](std::int64_t i, std::int64_t j) {
        return i < plane_side / 2 ? pattern(i, j) : 0.0F;
    });
    EXPECT_EQ(alternating_part(smooth, &inside), 0);
}

}  // namespace
}  // namespace cascade
