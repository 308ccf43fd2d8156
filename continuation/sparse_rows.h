// The types of vectors and matrices of continuation/.
#pragma once

#include <Eigen/SparseCore>

#include <complex>

namespace cascade::continuation {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Values = Eigen::ArrayXd;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor>;
using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

}  // namespace cascade::continuation
