// Eigenvalues, of small matrices by Eigen, of larger ones by Spectra in shift-and-invert mode.
//
// A neutral mode x with its left vector y is moved out of sight by adding a multiple of x yᵀ to the
// matrix (H. Wielandt, 1944), which changes no other eigenvalue. Instead of the sum, which is
// dense, a sparse matrix with one more row and column is factorised. A warning is off, because g++
// 12 takes memory of Eigen's elimination for used after its end.
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
#include <limits>
#include <optional>

namespace cascade::continuation {

namespace {

constexpr Index most_dense_symmetric = 320;
constexpr Index most_dense = 120;  ///< Smaller matrices are decomposed completely.
/// Smaller matrices are decomposed completely if the search does not converge.
constexpr Index most_dense_rescue = 1500;

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

/// Thrown to leave a search that is cancelled.
struct SearchEnded {};

/// The inverse of the matrix minus a shift. The matrix is bordered with the neutral modes.
template <typename Number>
class ShiftedInverse {
public:
    using Scalar = double;

    ShiftedInverse(const SparseColumns& matrix, std::span<const NeutralMode> neutral, double away,
                   const std::atomic<bool>* cancel)
        : matrix_(matrix), neutral_(neutral), away_(away), cancel_(cancel) {}

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
        if (cancel_ != nullptr && *cancel_) throw SearchEnded();
        const Index size = matrix_.rows();
        const Index all = size + static_cast<Index>(neutral_.size());
        if (!is_good_) {
            Eigen::Map<Vector>(out, size).setZero();
            return;
        }
        VectorOf right = VectorOf::Zero(all);
        right.head(size) = aside(Eigen::Map<const Vector>(in, size)).template cast<Number>();
        const VectorOf solved = lu_.solve(right);
        Eigen::Map<Vector>(out, size) = aside(solved.head(size).real());
    }

    /// Leaves out this eigenvector and its conjugate from now on, so that others are found.
    void lock(const ComplexVector& vector) {
        for (const Vector& part : {Vector(vector.real()), Vector(vector.imag())}) {
            const double length = part.norm();
            const Vector rest = aside(aside(part));
            if (length < 1e-6 || rest.norm() < 1e-6 * length) continue;
            locked_.conservativeResize(matrix_.rows(), locked_.cols() + 1);
            locked_.col(locked_.cols() - 1) = rest.normalized();
        }
    }
    Index locked_count() const { return locked_.cols(); }

private:
    using SparseOf = Eigen::SparseMatrix<Number>;
    using VectorOf = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

    /// The part of a vector that is orthogonal to the locked space.
    Vector aside(const Vector& vector) const {
        if (locked_.cols() == 0) return vector;
        return vector - locked_ * (locked_.transpose() * vector);
    }

    static Number number_of(double real, [[maybe_unused]] double imaginary) {
        if constexpr (std::is_same_v<Number, double>) return real;
        if constexpr (!std::is_same_v<Number, double>) return {real, imaginary};
    }

    const SparseColumns& matrix_;
    std::span<const NeutralMode> neutral_;
    double away_;
    const std::atomic<bool>* cancel_;
    Matrix locked_;  ///< Orthonormal columns.
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
    // The eigenvalues of the neutral modes have been moved to the smallest real parts.
    std::ranges::sort(modes, std::greater(), [](const Mode& mode) { return mode.value.real(); });
    modes.resize(modes.size() - std::min(modes.size(), neutral.size()));
    return modes;
}

bool is_symmetric(const SparseColumns& matrix, double size) {
    const SparseColumns other = matrix.transpose();
    return (matrix - other).norm() <= 1e-13 * size;
}

/// All eigenvalues of a symmetric matrix. The two vectors of each of its neutral modes are equal,
/// up to rounding and to the accuracy with which the grid moves a pattern.
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

/// A vector whose elements look random. It differs from pass to pass.
Vector start_of(Index size, int pass) {
    Vector start(size);
    for (Index k = 0; k < size; ++k) {
        start[k] = std::sin(0.37 + static_cast<double>(k + 1) * (1.618 + 0.7391 * pass));
    }
    return start;
}

/// The modes nearest to a shift. An iteration from one vector finds only one eigenvector of an
/// eigenvalue that occurs several times. So the iteration is repeated without the vectors that were
/// found, until it finds no mode that is nearer to the shift than the farthest mode of the first
/// pass. Empty if an iteration does not converge.
template <typename Solver, typename Inverse, typename... Shift>
std::optional<std::vector<Mode>> found_near(Inverse& inverse, Complex place, Index count,
                                            Shift... shift) {
    constexpr int most_passes = 24;
    std::vector<Mode> all;
    double radius = std::numeric_limits<double>::infinity();
    const auto distance = [&](Complex value) {
        return std::min(std::abs(value - place), std::abs(value - std::conj(place)));
    };
    for (int pass = 0; pass < most_passes; ++pass) {
        const Index free = inverse.rows() - inverse.locked_count();
        const Index wanted = pass == 0 ? count : std::min<Index>(count, 4);
        const Index basis = std::max<Index>(2 * wanted + 12, 30);
        if (free < basis) break;
        Solver solver(inverse, wanted, basis, shift...);
        if (!inverse.is_good()) return std::nullopt;
        const Vector start = start_of(inverse.rows(), pass);
        solver.init(start.data());
        solver.compute(Spectra::SortRule::LargestMagn, 400, 1e-12);
        if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
        const auto values = solver.eigenvalues();
        const auto vectors = solver.eigenvectors();
        const std::size_t before = all.size();
        for (Index k = 0; k < values.size(); ++k) {
            if (pass > 0 && distance(values[k]) > radius * (1 - 1e-6)) continue;
            all.push_back({values[k], vectors.col(k)});
            inverse.lock(all.back().vector);
            // The last mode may be half of a conjugate pair whose other half is missing.
            const bool is_half = values[k].imag() != 0 && k + 1 == values.size() &&
                                 (k == 0 || values[k - 1] != std::conj(values[k]));
            if (is_half) all.push_back({std::conj(values[k]), vectors.col(k).conjugate()});
        }
        if (all.size() == before) return all;
        if (pass > 0) continue;
        radius = 0;
        for (const Mode& mode : all) radius = std::max(radius, distance(mode.value));
    }
    return all;
}

std::optional<std::vector<Mode>> modes_near(const SparseColumns& matrix,
                                            std::span<const NeutralMode> neutral, double away,
                                            Complex place, Index count,
                                            const std::atomic<bool>* cancel) {
    if (place.imag() == 0) {
        using Inverse = ShiftedInverse<double>;
        Inverse inverse(matrix, neutral, away, cancel);
        return found_near<Spectra::GenEigsRealShiftSolver<Inverse>>(inverse, place, count,
                                                                    place.real());
    }
    using Inverse = ShiftedInverse<Complex>;
    Inverse inverse(matrix, neutral, away, cancel);
    return found_near<Spectra::GenEigsComplexShiftSolver<Inverse>>(inverse, place, count,
                                                                   place.real(), place.imag());
}

/// Adds the modes of `more` that `modes` does not contain yet.
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
                                std::span<const Complex> places, int count, bool with_vectors,
                                const std::atomic<bool>* cancel) try {
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
        auto near = modes_near(matrix, neutral, away, shift, wanted, cancel);
        if (!near) break;
        modes = *std::move(near);
        radius = 0;
        Index growing = 0;
        for (const Mode& mode : modes) {
            radius = std::max(radius, std::abs(mode.value - shift));
            growing += mode.value.real() > 0 ? 1 : 0;
        }
        is_found = growing + 2 < static_cast<Index>(modes.size());
        if (is_found) break;
    }
    // The discs in which all eigenvalues are known.
    std::vector<std::pair<Complex, double>> known{{shift, radius}};
    for (const Complex place : places) {
        const Complex at = place + (1e-6 * std::abs(place) + 1e-3 * shift);
        const auto distance = [&](Complex to) {
            return std::min(std::abs(to - at), std::abs(std::conj(to) - at));
        };
        const auto contains = [&](const auto& disc) { return distance(disc.first) < disc.second; };
        if (!is_found || std::ranges::any_of(known, contains)) continue;
        auto near = modes_near(matrix, neutral, away, at, std::max(4, count / 2), cancel);
        is_found = near.has_value();
        if (!near) continue;
        double farthest = 0;
        for (const Mode& mode : *near) farthest = std::max(farthest, distance(mode.value));
        known.emplace_back(at, farthest);
        join(modes, *std::move(near), 1e-7 * (std::abs(place) + radius));
    }
    if (!is_found) {
        if (size > most_dense_rescue) return {};
        return all_modes(matrix, neutral, away, with_vectors);
    }
    std::ranges::sort(modes, std::greater(), [](const Mode& mode) { return mode.value.real(); });
    return modes;
} catch (const SearchEnded&) {
    return {};
}

}  // namespace cascade::continuation
