// Decompositions of small dense matrices.
//
// Eigen's templates take seconds to compile, so each decomposition is used in only one file of
// analysis/. Other files include only Eigen/Core. No function fails. For a matrix with infinities
// or NaN, results are meaningless.
#pragma once

#include <Eigen/Core>

#include <complex>

namespace cascade::analysis {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

/// All eigenvalues of a square matrix, in any order.
ComplexVector eigenvalues_of(const Matrix& matrix);
ComplexVector eigenvalues_of(const ComplexMatrix& matrix);

/// An eigenvalue, and the real part of its eigenvector.
struct EigenPair {
    std::complex<double> value;
    Vector vector;
};
/// The eigenvalue of least magnitude of a square matrix, with its eigenvector.
EigenPair least_eigenpair(const Matrix& matrix);

/// The x with matrix · x = right, for a square matrix, by elimination with full pivoting. If the
/// matrix is singular, free components of x are 0.
Vector solution_of(const Matrix& matrix, const Vector& right);
/// The smallest magnitude of a pivot in the elimination of solution_of(). 0 if the matrix is
/// singular.
double least_pivot(const Matrix& matrix);

/// The x for which matrix · x − right is shortest, and the shortest such x if there are several.
/// The matrix has as many rows as `right` and any number of columns.
Vector least_squares(const Matrix& matrix, const Vector& right);
/// Does the same as least_squares() for each column of `right`.
ComplexMatrix least_squares(const ComplexMatrix& matrix, const ComplexMatrix& right);

/// The singular values of a matrix of any shape, in descending order. Their number is the smaller
/// of the numbers of rows and columns.
Vector singular_values(const Matrix& matrix);
/// Unit row vectors, orthogonal to each other and to all columns of the matrix. Their number is the
/// number of the matrix's rows minus its rank. Singular values of at most `resolution` times the
/// largest count as 0.
Matrix rows_across_columns(const Matrix& matrix, double resolution);

}  // namespace cascade::analysis
