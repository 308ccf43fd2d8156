// Solves equations by elimination column by column, and then by substitution from the last unknown
// to the first.
#include "lang/lower/cell_equations.h"

#include <utility>

namespace cascade::lowering {

namespace {

using Row = std::vector<ValueId>;

/// Exchanges two rows, from `column` on, if the second row has the number of larger magnitude in
/// this column.
void put_larger_first(KernelBuilder& builder, Row& first, Row& second, std::size_t column) {
    if (is_zero(builder, second[column])) return;
    if (is_zero(builder, first[column])) return std::swap(first, second);
    const auto size = [&](const Row& row) { return builder.apply(Op::absolute, row[column]); };
    const ValueId swaps = builder.apply(Op::less, size(first), size(second));
    for (std::size_t j = column; j < first.size(); ++j) {
        const ValueId a = first[j], b = second[j];
        first[j] = builder.select(swaps, b, a);
        second[j] = builder.select(swaps, a, b);
    }
}

/// value − factor · other.
ValueId less_product(KernelBuilder& builder, ValueId value, ValueId factor, ValueId other) {
    if (is_zero(builder, other)) return value;
    return builder.subtract(value, builder.multiply(factor, other));
}

}  // namespace

bool is_zero(const KernelBuilder& builder, ValueId value) {
    return builder.is_constant(value) && builder.constant(value) == 0;
}

std::vector<ValueId> solve_equations(KernelBuilder& builder, std::vector<Row> rows) {
    const std::size_t n = rows.size();
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = k + 1; i < n; ++i) put_larger_first(builder, rows[k], rows[i], k);
        for (std::size_t i = k + 1; i < n; ++i) {
            if (is_zero(builder, rows[i][k])) continue;
            const ValueId factor = builder.divide(rows[i][k], rows[k][k]);
            for (std::size_t j = k + 1; j <= n; ++j) {
                rows[i][j] = less_product(builder, rows[i][j], factor, rows[k][j]);
            }
        }
    }
    std::vector<ValueId> x(n);
    for (std::size_t k = n; k-- > 0;) {
        ValueId rest = rows[k][n];
        for (std::size_t j = k + 1; j < n; ++j) {
            if (!is_zero(builder, rows[k][j])) rest = less_product(builder, rest, rows[k][j], x[j]);
        }
        x[k] = builder.divide(rest, rows[k][k]);
    }
    return x;
}

}  // namespace cascade::lowering
