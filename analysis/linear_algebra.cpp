// Linear systems and singular values. Only this file and eigenvalues.cpp include more of Eigen than
// its matrices.
#include "analysis/linear_algebra.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace cascade::analysis {

Vector solution_of(const Matrix& matrix, const Vector& right) {
    return matrix.fullPivLu().solve(right);
}

double least_pivot(const Matrix& matrix) {
    return matrix.fullPivLu().matrixLU().diagonal().cwiseAbs().minCoeff();
}

Vector least_squares(const Matrix& matrix, const Vector& right) {
    return matrix.completeOrthogonalDecomposition().solve(right);
}

ComplexMatrix least_squares(const ComplexMatrix& matrix, const ComplexMatrix& right) {
    return matrix.completeOrthogonalDecomposition().solve(right);
}

Vector singular_values(const Matrix& matrix) { return matrix.jacobiSvd().singularValues(); }

Matrix rows_across_columns(const Matrix& matrix, double resolution) {
    const Eigen::JacobiSVD<Matrix> svd(matrix, Eigen::ComputeFullU);
    const Vector values = svd.singularValues();
    Eigen::Index rank = 0;
    while (rank < values.size() && values[rank] > resolution * values[0]) ++rank;
    return svd.matrixU().rightCols(matrix.rows() - rank).transpose();
}

}  // namespace cascade::analysis
