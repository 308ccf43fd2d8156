// Eigenvalues, of small matrices by Eigen, of larger ones by Spectra in shift-and-invert mode.
//
// A neutral mode x with its left vector y is moved out of sight by adding a multiple of x yᵀ to the
// matrix (H. Wielandt, 1944), which changes no other eigenvalue. Factors of the sum are factors of
// a sparse matrix with one more row and column.
// g++ 12 takes memory of Eigen's elimination for used after its end.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif

#include "continuation/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>
#include <Spectra/GenEigsComplexShiftSolver.h>
#include <Spectra/GenEigsRealShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade::continuation {

namespace {

constexpr Index most_dense_symmetric = 320;
constexpr Index most_dense = 120;          ///< Smaller matrices are decomposed completely.
constexpr Index most_dense_rescue = 1500;  ///< The same if the search does not converge.

/// The largest sum of magnitudes in a row.
double size_of(const SparseColumns& matrix) {
    Vector sums = Vector::Zero(matrix.rows());
    for (Index column = 0; column < matrix.cols(); ++column) {
        for (SparseColumns::InnerIterator entry(matrix, column); entry; ++entry) {
            sums[entry.row()] += std::abs(entry.value());
        }
    }
    return sums.size() > 0 ? sums.maxCoeff() : 0;
}

/// The matrix minus a shift, bordered with the neutral modes.
template <typename Number>
class ShiftedInverse {
public:
    using Scalar = double;

    ShiftedInverse(const SparseColumns& matrix, std::span<const NeutralMode> neutral, double away)
        : matrix_(matrix), neutral_(neutral), away_(away) {}

    Index rows() const { return matrix_.rows(); }
    Index cols() const { return matrix_.cols(); }
    void set_shift(double real, double imaginary = 0) {
        const auto count = static_cast<Index>(neutral_.size());
        const Index size = matrix_.rows();
        Matrix right(size, count), left(count, size);
        for (Index k = 0; k < count; ++k) {
            right.col(k) = -away_ * neutral_[static_cast<std::size_t>(k)].right;
            left.row(k) = neutral_[static_cast<std::size_t>(k)].left.transpose();
        }
        const SparseColumns whole =
            with_border(matrix_, right, left, -Matrix::Identity(count, count));
        SparseOf shifted = whole.template cast<Number>();
        SparseOf shift(whole.rows(), whole.cols());
        shift.reserve(Eigen::VectorXi::Constant(whole.cols(), 1));
        for (Index k = 0; k < size; ++k) shift.insert(k, k) = number_of(real, imaginary);
        shifted -= shift;
        lu_.setPivotThreshold(0.1);
        lu_.compute(shifted);
        is_good_ = lu_.info() == Eigen::Success;
    }
    bool is_good() const { return is_good_; }
    void perform_op(const double* in, double* out) const {
        const Index size = matrix_.rows();
        const Index all = size + static_cast<Index>(neutral_.size());
        VectorOf right = VectorOf::Zero(all);
        right.head(size) = Eigen::Map<const Vector>(in, size).template cast<Number>();
        if (!is_good_) {
            Eigen::Map<Vector>(out, size).setZero();
            return;
        }
        const VectorOf solved = lu_.solve(right);
        Eigen::Map<Vector>(out, size) = solved.head(size).real();
    }

private:
    using SparseOf = Eigen::SparseMatrix<Number>;
    using VectorOf = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

    static Number number_of(double real, [[maybe_unused]] double imaginary) {
        if constexpr (std::is_same_v<Number, double>) return real;
        if constexpr (!std::is_same_v<Number, double>) return {real, imaginary};
    }

    const SparseColumns& matrix_;
    std::span<const NeutralMode> neutral_;
    double away_;
    Eigen::SparseLU<SparseOf> lu_;
    bool is_good_ = false;
};

std::vector<Mode> all_modes(const SparseColumns& matrix, std::span<const NeutralMode> neutral,
                            double away, bool with_vectors) {
    Matrix dense = matrix;
    for (const NeutralMode& mode : neutral) dense -= away * mode.right * mode.left.transpose();
    const Eigen::EigenSolver<Matrix> solver(dense, with_vectors);
    std::vector<Mode> modes;
    if (solver.info() != Eigen::Success) return modes;
    for (Index k = 0; k < dense.rows(); ++k) {
        modes.push_back({solver.eigenvalues()[k], {}});
        if (with_vectors) modes.back().vector = solver.eigenvectors().col(k);
    }
    // The neutral modes are now the farthest to the left.
    std::ranges::sort(modes, std::greater(), [](const Mode& mode) { return mode.value.real(); });
    modes.resize(modes.size() - std::min(modes.size(), neutral.size()));
    return modes;
}

bool is_symmetric(const SparseColumns& matrix, double size) {
    const SparseColumns other = matrix.transpose();
    return (matrix - other).norm() <= 1e-13 * size;
}

/// All eigenvalues of a symmetric matrix. A neutral mode of it is its own left vector, to rounding
/// and the accuracy with which the grid moves a pattern.
std::vector<Mode> all_of_symmetric(const SparseColumns& matrix,
                                   std::span<const NeutralMode> neutral, double away) {
    Matrix dense = matrix;
    for (const NeutralMode& mode : neutral) {
        const Vector unit = mode.right.normalized();
        dense -= away * unit * unit.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(dense, Eigen::EigenvaluesOnly);
    std::vector<Mode> modes;
    if (solver.info() != Eigen::Success) return modes;
    for (Index k = dense.rows(); k-- > static_cast<Index>(neutral.size());) {
        modes.push_back({solver.eigenvalues()[k], {}});
    }
    return modes;
}

/// Takes the modes that an iteration has found. Empty if it has not converged.
template <typename Solver>
std::optional<std::vector<Mode>> found_by(Solver& solver, bool with_vectors) {
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, 400, 1e-12);
    if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
    std::vector<Mode> modes;
    const auto values = solver.eigenvalues();
    Eigen::MatrixXcd vectors;
    if (with_vectors) vectors = solver.eigenvectors();
    for (Index k = 0; k < values.size(); ++k) {
        modes.push_back({values[k], {}});
        if (with_vectors) modes.back().vector = vectors.col(k);
    }
    return modes;
}

std::optional<std::vector<Mode>> modes_near(const SparseColumns& matrix,
                                            std::span<const NeutralMode> neutral, double away,
                                            Complex place, Index count, bool with_vectors) {
    const Index basis = std::min(matrix.rows(), std::max<Index>(2 * count + 12, 36));
    if (place.imag() == 0) {
        ShiftedInverse<double> inverse(matrix, neutral, away);
        Spectra::GenEigsRealShiftSolver<ShiftedInverse<double>> solver(inverse, count, basis,
                                                                       place.real());
        if (!inverse.is_good()) return std::nullopt;
        return found_by(solver, with_vectors);
    }
    ShiftedInverse<Complex> inverse(matrix, neutral, away);
    Spectra::GenEigsComplexShiftSolver<ShiftedInverse<Complex>> solver(inverse, count, basis,
                                                                       place.real(), place.imag());
    if (!inverse.is_good()) return std::nullopt;
    return found_by(solver, with_vectors);
}

/// Adds modes that are not there yet.
void join(std::vector<Mode>& modes, std::vector<Mode> more, double apart) {
    const std::size_t before = modes.size();
    for (Mode& mode : more) {
        const auto is_same = [&](const Mode& known) {
            return std::abs(known.value - mode.value) < apart;
        };
        const auto end = modes.begin() + static_cast<std::ptrdiff_t>(before);
        if (std::none_of(modes.begin(), end, is_same)) modes.push_back(std::move(mode));
    }
}

}  // namespace

std::vector<Complex> eigenvalues_of(const Matrix& matrix) {
    const auto values = Eigen::EigenSolver<Matrix>(matrix, false).eigenvalues();
    return {values.begin(), values.end()};
}

std::vector<Mode> leading_modes(const SparseColumns& matrix, std::span<const NeutralMode> neutral,
                                std::span<const double> turning, int count, bool with_vectors) {
    const double away = size_of(matrix);
    const Index size = matrix.rows();
    if (size <= most_dense_symmetric && !with_vectors && is_symmetric(matrix, away)) {
        return all_of_symmetric(matrix, neutral, away);
    }
    if (size <= most_dense) return all_modes(matrix, neutral, away, with_vectors);
    std::vector<Mode> modes;
    bool is_found = false;
    double radius = 0;
    const double shift = 1e-4 * away;
    for (Index wanted = count; wanted < size / 2; wanted *= 2) {
        auto near = modes_near(matrix, neutral, away, shift, wanted, with_vectors);
        if (!near) break;
        modes = *std::move(near);
        radius = 0;
        Index growing = 0;
        for (const Mode& mode : modes) {
            radius = std::max(radius, std::abs(mode.value - shift));
            growing += mode.value.real() > 0 ? 1 : 0;
        }
        is_found = growing + 2 < wanted;
        if (is_found) break;
    }
    for (const double frequency : turning) {
        if (!is_found || frequency < radius) continue;
        auto near = modes_near(matrix, neutral, away, {shift, frequency}, std::max(4, count / 2),
                               with_vectors);
        is_found = near.has_value();
        if (near) join(modes, *std::move(near), 1e-7 * (frequency + radius));
    }
    if (!is_found) {
        if (size > most_dense_rescue) return {};
        return all_modes(matrix, neutral, away, with_vectors);
    }
    std::ranges::sort(modes, std::greater(), [](const Mode& mode) { return mode.value.real(); });
    return modes;
}

}  // namespace cascade::continuation
