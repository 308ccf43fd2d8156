// Decompositions of small dense matrices.
//
// Eigen's templates take seconds to compile, so each decomposition is in one file of this room, and
// other files include only Eigen/Core. No function fails. The results for a matrix with infinities
// or NaN are meaningless.
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
/// The pair with the eigenvalue of least magnitude of a square matrix.
EigenPair least_eigenpair(const Matrix& matrix);

/// The x with matrix · x = right, for a square matrix, by elimination with full pivoting. If the
/// matrix is singular, the free components of x are 0.
Vector solution_of(const Matrix& matrix, const Vector& right);
/// The least magnitude of the pivots of that elimination. 0 for a singular matrix.
double least_pivot(const Matrix& matrix);

/// The shortest x with the least length of matrix · x − right. The matrix has as many rows as
/// `right` and any number of columns.
Vector least_squares(const Matrix& matrix, const Vector& right);
/// The same for each column of `right`.
ComplexMatrix least_squares(const ComplexMatrix& matrix, const ComplexMatrix& right);

/// By decreasing size: as many as the smaller side of the matrix, which may have any shape.
Vector singular_values(const Matrix& matrix);
/// Unit row vectors, orthogonal to each other and to all columns of the matrix. There are as many
/// as the matrix has rows, minus its rank. Singular values of at most `resolution` times the
/// largest count as 0.
Matrix rows_across_columns(const Matrix& matrix, double resolution);

}  // namespace cascade::analysis
