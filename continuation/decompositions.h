// Decompositions of matrices. Each template of Eigen and Spectra that takes long to compile is used
// in only one file.
#pragma once

#include "continuation/sparse_rows.h"

#include <memory>
#include <atomic>
#include <span>
#include <vector>

namespace cascade::continuation {

/// Unit column vectors, orthogonal to each other and to all columns of a matrix with few rows. A
/// direction counts as orthogonal, too, if the vector of the columns' components along it is no
/// longer than `tolerance`.
Matrix across_rows(const Matrix& matrix, double tolerance);

/// The factors of a square sparse matrix.
class Factors {
public:
    explicit Factors(const SparseColumns& matrix);
    ~Factors();
    Factors(Factors&&) noexcept;

    /// Whether the matrix has an inverse, as far as the elimination shows. A sparse elimination
    /// does not notice every singular matrix, so callers must check each solution.
    bool is_regular() const;
    /// The sign of the determinant: 1 or −1.
    int sign() const;
    Vector solve(const Vector& right) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

/// The matrix (matrix, columns; rows, corner), that is, `matrix` with a border of a few columns and
/// rows.
SparseColumns with_border(const SparseColumns& matrix, const Matrix& columns, const Matrix& rows,
                          const Matrix& corner);

/// An eigenvector that does not count for stability. Either `right` is an eigenvector with
/// eigenvalue 0, or `left` is an eigenvector of the transposed matrix with eigenvalue 0. The scalar
/// product of both is 1.
struct NeutralMode {
    Vector right, left;
};

struct Mode {
    Complex value;
    ComplexVector vector;  ///< The eigenvector; empty unless requested.
};

/// Finds at least `count` eigenvalues of a square matrix (or all, if there are fewer), those with
/// the largest real parts, and sorts them by decreasing real part. Neutral modes are left out.
/// Small matrices are decomposed completely. For larger ones, finds the eigenvalues nearest to 0,
/// and then the eigenvalues nearest to each of `places` outside the region searched so far. Empty
/// if the search does not converge, or if `cancel`, which may be null, becomes true.
std::vector<Mode> leading_modes(const SparseColumns& matrix, std::span<const NeutralMode> neutral,
                                std::span<const Complex> places, int count, bool with_vectors,
                                const std::atomic<bool>* cancel);

/// The eigenvalues of a small dense matrix.
std::vector<Complex> eigenvalues_of(const Matrix& matrix);

}  // namespace cascade::continuation
