// Sparse elimination, and the null space of small matrices.
#include "continuation/decompositions.h"

#include <Eigen/SparseLU>
#include <Eigen/SVD>

namespace cascade::continuation {

Matrix across_rows(const Matrix& matrix, double tolerance) {
    const Matrix square = matrix * matrix.transpose();
    const Eigen::JacobiSVD<Matrix> svd(square, Eigen::ComputeFullU);
    Index rank = 0;
    while (rank < square.rows() && svd.singularValues()[rank] > tolerance * tolerance) ++rank;
    return svd.matrixU().rightCols(square.rows() - rank);
}

struct Factors::Implementation {
    Eigen::SparseLU<SparseColumns> lu;
};

Factors::Factors(const SparseColumns& matrix) : self_(std::make_unique<Implementation>()) {
    // Borders are dense, so pivots near the diagonal are preferred, which keeps the factors sparse.
    self_->lu.setPivotThreshold(0.1);
    self_->lu.compute(matrix);
}
Factors::~Factors() = default;
Factors::Factors(Factors&&) noexcept = default;

bool Factors::is_regular() const { return self_->lu.info() == Eigen::Success; }

int Factors::sign() const { return self_->lu.signDeterminant() < 0 ? -1 : 1; }

Vector Factors::solve(const Vector& right) const { return self_->lu.solve(right); }

SparseColumns with_border(const SparseColumns& matrix, const Matrix& columns, const Matrix& rows,
                          const Matrix& corner) {
    const Index size = matrix.rows();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(matrix.nonZeros() + 2 * size * columns.cols()));
    const auto add = [&](Index row, Index column, double value) {
        if (value != 0) entries.emplace_back(row, column, value);
    };
    for (Index column = 0; column < size; ++column) {
        for (SparseColumns::InnerIterator entry(matrix, column); entry; ++entry) {
            entries.emplace_back(entry.row(), column, entry.value());
        }
    }
    for (Index k = 0; k < columns.cols(); ++k) {
        for (Index row = 0; row < size; ++row) add(row, size + k, columns(row, k));
    }
    for (Index k = 0; k < rows.rows(); ++k) {
        for (Index column = 0; column < size; ++column) add(size + k, column, rows(k, column));
        for (Index other = 0; other < columns.cols(); ++other) {
            add(size + k, size + other, corner(k, other));
        }
    }
    SparseColumns bordered(size + rows.rows(), size + columns.cols());
    bordered.setFromTriplets(entries.begin(), entries.end());
    return bordered;
}

}  // namespace cascade::continuation
