// Eigenvalues and eigenvectors. This file is separate from the other decompositions because
// compiling each of them takes 1 GiB of memory.
#include "analysis/linear_algebra.h"

#include <Eigen/Eigenvalues>

namespace cascade::analysis {

ComplexVector eigenvalues_of(const Matrix& matrix) {
    return Eigen::EigenSolver<Matrix>(matrix, false).eigenvalues();
}

ComplexVector eigenvalues_of(const ComplexMatrix& matrix) {
    return Eigen::ComplexEigenSolver<ComplexMatrix>(matrix, false).eigenvalues();
}

EigenPair least_eigenpair(const Matrix& matrix) {
    const Eigen::EigenSolver<Matrix> solver(matrix);
    Eigen::Index least = 0;
    solver.eigenvalues().cwiseAbs().minCoeff(&least);
    return {solver.eigenvalues()[least], solver.eigenvectors().col(least).real()};
}

}  // namespace cascade::analysis
