// Equations of a cell with constant numbers, so that the builder folds their solution to numbers.
#include "lang/lower/cell_equations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade::lowering {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// The largest error of the solution of matrix · x = right, whose solution is `expected`.
double error_of(const Matrix& matrix, const std::vector<double>& expected) {
    KernelBuilder builder(Precision::binary64);
    std::vector<std::vector<ValueId>> rows;
    for (const std::vector<double>& entries : matrix) {
        std::vector<ValueId>& row = rows.emplace_back();
        double right = 0;
        for (std::size_t j = 0; j < entries.size(); ++j) {
            row.push_back(builder.number(entries[j]));
            right += entries[j] * expected[j];
        }
        row.push_back(builder.number(right));
    }
    const std::vector<ValueId> x = solve_equations(builder, rows);
    double most = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        most = std::max(most, std::abs(builder.constant(x[k]) - expected[k]));
    }
    return most;
}

TEST(CellEquations, AreSolvedWhateverTheOrderOfTheirRows) {
    EXPECT_LT(error_of({{2}}, {3}), 1e-15);
    EXPECT_LT(error_of({{0, 2}, {3, 1}}, {-1, 4}), 1e-14);
    EXPECT_LT(error_of({{0, 0, 5}, {0, -2, 0}, {7, 0, 0}}, {1, 2, 3}), 1e-14);
    EXPECT_LT(error_of({{1, 2, 0}, {2, 4, 1}, {0, 3, 1}}, {0.5, -3, 2}), 1e-13);
}

/// Without an exchange of rows, a small pivot would lose all digits.
TEST(CellEquations, LoseNoDigitsWhereAPivotIsSmall) {
    EXPECT_LT(error_of({{1e-17, 1}, {1, 1}}, {1, 2}), 1e-14);
    EXPECT_LT(error_of({{1, 1, 1}, {1, 1 + 1e-16, 2}, {1, 3, -1}}, {1, 2, 3}), 1e-13);
}

TEST(CellEquations, OfManyUnknownsAreSolvedToRounding) {
    std::uint32_t state = 1;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) / (1 << 24) - 0.5;
    };
    for (std::size_t n = 2; n <= 12; ++n) {
        Matrix matrix(n, std::vector<double>(n));
        std::vector<double> expected(n);
        for (std::size_t i = 0; i < n; ++i) {
            for (double& entry : matrix[i]) entry = next();
            expected[i] = next();
        }
        EXPECT_LT(error_of(matrix, expected), 1e-11) << n;
    }
}

TEST(CellEquations, OfUnknownsThatAreApartCostADivisionEach) {
    KernelBuilder builder;
    const auto value = [&](const char* name) {
        return builder.uniform(builder.uniform_slot(name));
    };
    const ValueId zero = builder.number(0);
    const ValueId a = value("a"), b = value("b"), c = value("c"), d = value("d");
    const ValueId before = builder.next();
    const auto x = solve_equations(builder, {{a, zero, b}, {zero, c, d}});
    EXPECT_EQ(builder.next().index() - before.index(), 2u);
    EXPECT_EQ(builder[x[0]].op, Op::divide);
    EXPECT_EQ(builder[x[1]].op, Op::divide);
}

TEST(CellEquations, ThatAreSingularHaveNoFiniteSolution) {
    KernelBuilder builder;
    const auto number = [&](double value) { return builder.number(value); };
    const auto x = solve_equations(builder, {{number(1), number(2), number(3)},
                                             {number(2), number(4), number(5)}});
    EXPECT_FALSE(std::isfinite(builder.constant(x[1])));
}

}  // namespace
}  // namespace cascade::lowering
