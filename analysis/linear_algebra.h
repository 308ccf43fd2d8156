// Decompositions of small dense matrices.
//
// Eigen's templates take seconds to compile, so each decomposition has one place in this room:
// other files include no more than Eigen/Core. No function fails: of a matrix with infinities or
// NaN the results mean nothing.
#pragma once

#include <Eigen/Core>

#include <complex>

namespace cascade::analysis {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

/// All eigenvalues of a square matrix, in no order.
ComplexVector eigenvalues_of(const Matrix& matrix);
ComplexVector eigenvalues_of(const ComplexMatrix& matrix);

/// An eigenvalue, and the real part of its eigenvector.
struct EigenPair {
    std::complex<double> value;
    Vector vector;
};
/// Those of a square matrix for its eigenvalue of least magnitude.
EigenPair least_eigenpair(const Matrix& matrix);

/// The x with matrix · x = right, for a square matrix, by elimination with full pivoting. If the
/// matrix is singular, the components of x that are free are 0.
Vector solution_of(const Matrix& matrix, const Vector& right);
/// The least magnitude of the pivots of that elimination; 0 for a singular matrix.
double least_pivot(const Matrix& matrix);

/// The shortest of the x for which the length of matrix · x − right is least. The matrix has as
/// many rows as `right` and any number of columns.
Vector least_squares(const Matrix& matrix, const Vector& right);
/// The same for each column of `right`.
ComplexMatrix least_squares(const ComplexMatrix& matrix, const ComplexMatrix& right);

/// By decreasing size: as many as the smaller side of the matrix, which may have any shape.
Vector singular_values(const Matrix& matrix);
/// Rows of length 1, orthogonal to each other and to all columns of the matrix: as many as its rows
/// less its rank. Singular values up to `resolution` of the largest count as 0.
Matrix rows_across_columns(const Matrix& matrix, double resolution);

}  // namespace cascade::analysis
