// The rules of sums and products.
#include "continuation/part.h"

#include "core/check.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cascade::continuation {

namespace {

SparseRows repeated(const SparseRows& row, Index size) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(row.nonZeros() * size));
    for (Index to = 0; to < size; ++to) {
        for (SparseRows::InnerIterator entry(row, 0); entry; ++entry) {
            entries.emplace_back(to, entry.col(), entry.value());
        }
    }
    SparseRows result(size, row.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

}  // namespace

Values spread(const Values& values, Index size) {
    return values.size() == size ? values : Values::Constant(size, values[0]);
}

SparseRows scaled(const Values& factors, const SparseRows& rows) {
    if (factors.size() == 1) return rows * factors[0];
    if (rows.rows() == factors.size()) return factors.matrix().asDiagonal() * rows;
    return factors.matrix().asDiagonal() * repeated(rows, factors.size());
}

void add_rows(SparseRows& sum, SparseRows rows) {
    if (rows.rows() == 0) return;
    if (sum.rows() == 0) {
        sum = std::move(rows);
        return;
    }
    const Index size = std::max(sum.rows(), rows.rows());
    if (sum.rows() < size) sum = repeated(sum, size);
    if (rows.rows() < size) rows = repeated(rows, size);
    sum += rows;
}

Part sum(const Part& a, const Part& b) {
    const Index size = std::max(a.values.size(), b.values.size());
    Part result{spread(a.values, size) + spread(b.values, size), a.slopes};
    add_rows(result.slopes, b.slopes);
    if (!result.is_constant() && result.slopes.rows() < size) {
        result.slopes = repeated(result.slopes, size);
    }
    return result;
}

Part product(const Part& a, const Part& b) {
    const Index size = std::max(a.values.size(), b.values.size());
    const Values first = spread(a.values, size), second = spread(b.values, size);
    Part result{first * second, {}};
    if (!a.is_constant()) add_rows(result.slopes, scaled(second, a.slopes));
    if (!b.is_constant()) add_rows(result.slopes, scaled(first, b.slopes));
    return result;
}

Part quotient(const Part& a, const Part& b) {
    Part inverse{b.values.inverse(), {}};
    if (!b.is_constant()) inverse.slopes = scaled(-inverse.values.square(), b.slopes);
    return product(a, inverse);
}

Part scaled(const Part& part, double factor) {
    return {part.values * factor, part.is_constant() ? part.slopes : part.slopes * factor};
}

Part applied(const SparseRows& matrix, const Part& part) {
    CHECK(!part.is_uniform() || matrix.cols() == 1, "an operator reads values of cells");
    Part result{(matrix * part.values.matrix()).array(), {}};
    if (!part.is_constant()) result.slopes = matrix * part.slopes;
    return result;
}

}  // namespace cascade::continuation
