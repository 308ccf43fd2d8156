// Decompositions of matrices. Each of Eigen's and Spectra's templates that take long to compile is
// used in one file only.
#pragma once

#include "continuation/sparse_rows.h"

#include <memory>
#include <atomic>
#include <span>
#include <vector>

namespace cascade::continuation {

/// Unit column vectors, orthogonal to each other and to all columns of a matrix with few rows. A
/// direction also counts as orthogonal if the components of all columns along it, as a vector, are
/// no longer than `tolerance`.
Matrix across_rows(const Matrix& matrix, double tolerance);

/// The factors of a square sparse matrix.
class Factors {
public:
    explicit Factors(const SparseColumns& matrix);
    ~Factors();
    Factors(Factors&&) noexcept;

    /// Whether the matrix has an inverse, as far as the elimination shows. A sparse elimination
    /// does not notice every singular matrix, so check each solution.
    bool is_regular() const;
    /// The sign of the determinant: 1, or −1.
    int sign() const;
    Vector solve(const Vector& right) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

/// A matrix with a border of a few columns and rows: (matrix, columns; rows, corner).
SparseColumns with_border(const SparseColumns& matrix, const Matrix& columns, const Matrix& rows,
                          const Matrix& corner);

/// An eigenvector that does not count: either `right` is an eigenvector with eigenvalue 0, or
/// `left` is one of the transposed matrix. The scalar product of both is 1.
struct NeutralMode {
    Vector right, left;
};

struct Mode {
    Complex value;
    ComplexVector vector;  ///< Empty unless requested.
};

/// The eigenvalues of a square matrix with the largest real parts, by decreasing real part: at
/// least `count`, if the matrix has so many. Neutral modes are left out. Small matrices are
/// decomposed completely. For larger ones, finds the eigenvalues nearest to 0, and then those
/// nearest to each of `places` that lies outside the region found so far. Empty if the search does
/// not converge, or if `cancel`, which may be null, becomes true.
std::vector<Mode> leading_modes(const SparseColumns& matrix, std::span<const NeutralMode> neutral,
                                std::span<const Complex> places, int count, bool with_vectors,
                                const std::atomic<bool>* cancel);

/// The eigenvalues of a small dense matrix.
std::vector<Complex> eigenvalues_of(const Matrix& matrix);

}  // namespace cascade::continuation
