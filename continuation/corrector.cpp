// Each step of Newton's method is one sparse elimination. Its matrix is the Jacobian, bordered by
// the equations of the arc and of the freedoms (H. B. Keller, "Numerical solution of bifurcation
// and nonlinear eigenvalue problems", 1977).
#include "continuation/corrector.h"

#include <cmath>
#include <limits>

namespace cascade::continuation {

namespace {

constexpr int most_rounds = 12;
constexpr int rounds_of_modes = 5;
/// The iteration ends after a step shorter than this, as Scales measures lengths.
constexpr double end_of_steps = 1e-9;
/// The largest rate that counts as 0, as a fraction of size_of_rates().
constexpr double largest_residual = 1e-8;

/// Solves a system, and refines the solution once from its residual. Empty if the matrix has no
/// inverse.
std::optional<Vector> solution(const SparseColumns& matrix, const Factors& factors,
                               const Vector& right) {
    Vector x = factors.solve(right);
    if (!x.allFinite()) return std::nullopt;
    const Vector rest = right - matrix * x;
    x += factors.solve(rest);
    if (!x.allFinite()) return std::nullopt;
    // The elimination does not report every singular matrix, so the solution is checked.
    const Vector left = right - matrix * x;
    return left.norm() <= 1e-6 * right.norm() ? std::optional(x) : std::nullopt;
}

}  // namespace

void Scales::normalise(Direction& direction) const {
    const double size = length(direction);
    direction.state /= size;
    direction.parameter /= size;
}

Freedoms Corrector::freedoms_at(const Place& place) const {
    std::vector<Vector> moved;
    if (holds_motions_) {
        for (Vector& each : problem_.motions(place.state)) {
            // A motion does not change a uniform state, and a motion along stripes does not change
            // the stripes.
            const double size = std::sqrt((each.array().square() * scales_.weights.array()).sum());
            if (size < 1e-6) continue;
            // Motions along both axes change oblique stripes in the same way, so only one of the
            // two counts.
            const double length = each.norm();
            for (const Vector& other : moved) each -= other.dot(each) * other;
            if (each.norm() > problem_.least_part() * length) moved.push_back(each.normalized());
        }
    }
    const auto count = static_cast<Index>(moved.size()) + totals_.cols();
    Freedoms freedoms{Matrix(problem_.size(), count), Matrix(count, problem_.size())};
    for (Index k = 0; k < static_cast<Index>(moved.size()); ++k) {
        freedoms.columns.col(k) = moved[static_cast<std::size_t>(k)];
    }
    for (Index k = 0; k < totals_.cols(); ++k) {
        freedoms.columns.col(static_cast<Index>(moved.size()) + k) = totals_.col(k).normalized();
    }
    freedoms.rows = freedoms.columns.transpose();
    return freedoms;
}

SparseColumns Corrector::whole(const Linearised& at, const Freedoms& freedoms,
                               const Direction& direction) const {
    const Index size = problem_.size(), count = freedoms.count();
    Matrix columns(size, count + 1), rows(count + 1, size),
        corner = Matrix::Zero(count + 1, count + 1);
    columns << at.by_parameter, freedoms.columns;
    rows.topRows(1) = (direction.state.array() * scales_.weights.array()).matrix().transpose();
    rows.bottomRows(count) = freedoms.rows;
    corner(0, 0) = scales_.parameter * direction.parameter;
    return with_border(at.jacobian, columns, rows, corner);
}

/// Adds up, for each rate, the magnitudes of its linear terms. Returns the largest sum.
double Corrector::size_of_rates(const Linearised& at, const Vector& state) const {
    Vector sums = Vector::Constant(state.size(), 1e-300);
    for (Index column = 0; column < at.jacobian.cols(); ++column) {
        for (SparseColumns::InnerIterator entry(at.jacobian, column); entry; ++entry) {
            const double usual =
                1 / std::sqrt(scales_.weights[column] * static_cast<double>(state.size()));
            sums[entry.row()] +=
                std::abs(entry.value()) * std::max(std::abs(state[column]), 1e-3 * usual);
        }
    }
    return sums.maxCoeff();
}

std::optional<Corrector::Solved> Corrector::solve(const Place& guess, const Direction& direction) {
    Solved solved{guess, {}, 0, 0};
    const Freedoms freedoms = freedoms_at(guess);
    const Index size = problem_.size(), count = freedoms.count();
    Vector extra = Vector::Zero(count);
    double before = std::numeric_limits<double>::infinity();
    for (solved.rounds = 1; solved.rounds <= most_rounds; ++solved.rounds) {
        solved.at = problem_.linearised(solved.place.state, solved.place.parameter);
        if (!solved.at.rates.allFinite()) return std::nullopt;
        const Direction way{solved.place.state - guess.state,
                            solved.place.parameter - guess.parameter};
        Vector right(size + count + 1);
        right << -(solved.at.rates + freedoms.columns * extra), -scales_.product(direction, way),
            -(freedoms.rows * way.state);
        const SparseColumns matrix = whole(solved.at, freedoms, direction);
        const Factors factors(matrix);
        if (!factors.is_regular()) return std::nullopt;
        const auto step = solution(matrix, factors, right);
        if (!step) return std::nullopt;
        const Direction change{step->head(size), (*step)[size]};
        solved.place.state += change.state;
        solved.place.parameter += change.parameter;
        extra += step->tail(count);
        const double length = scales_.length(change);
        if (length < end_of_steps) break;
        if (solved.rounds > 3 && length > before) return std::nullopt;
        before = length;
    }
    if (solved.rounds > most_rounds) return std::nullopt;
    solved.at = problem_.linearised(solved.place.state, solved.place.parameter);
    const double sizes = size_of_rates(solved.at, solved.place.state);
    const Vector rest = solved.at.rates + freedoms.columns * extra;
    if (!(rest.cwiseAbs().maxCoeff() <= largest_residual * sizes)) return std::nullopt;
    solved.drift = (freedoms.columns * extra).cwiseAbs().maxCoeff() / sizes;
    return solved;
}

std::optional<Tangent> Corrector::tangent(const Solved& at, const Direction& direction) const {
    const Freedoms freedoms = freedoms_at(at.place);
    const Index size = problem_.size();
    const SparseColumns matrix = whole(at.at, freedoms, direction);
    const Factors factors(matrix);
    if (!factors.is_regular()) return std::nullopt;
    Vector right = Vector::Zero(size + 1 + freedoms.count());
    right[size] = 1;
    const auto solved = solution(matrix, factors, right);
    if (!solved) return std::nullopt;
    Tangent tangent{{solved->head(size), (*solved)[size]}, factors.sign(), freedoms.count()};
    scales_.normalise(tangent);
    return tangent;
}

std::vector<NeutralMode> Corrector::neutral_modes(const Solved& at) const {
    const Freedoms freedoms = freedoms_at(at.place);
    const Index size = problem_.size(), count = freedoms.count();
    const Index moves = count - totals_.cols();
    std::vector<NeutralMode> modes;
    if (moves > 0) {
        // Finds the eigenvectors X near the motions B: J X + B N = X Λ with Bᵀ X = 1. Each round
        // changes Λ so that N tends to 0. Λ is near 0 if the cells hold the pattern only weakly.
        const SparseColumns matrix = with_border(at.at.jacobian, freedoms.columns, freedoms.rows,
                                                 Matrix::Zero(count, count));
        const Factors factors(matrix);
        Matrix found = freedoms.columns.leftCols(moves), values = Matrix::Zero(moves, moves);
        bool is_good = factors.is_regular();
        for (int round = 0; round < rounds_of_modes && is_good; ++round) {
            Matrix right = Matrix::Zero(size + count, moves);
            right.topRows(size) = found * values;
            right.middleRows(size, moves).setIdentity();
            Matrix rest(moves, moves);
            for (Index k = 0; k < moves && is_good; ++k) {
                const auto solved = solution(matrix, factors, right.col(k));
                is_good = solved.has_value();
                if (!is_good) break;
                found.col(k) = solved->head(size);
                rest.col(k) = solved->segment(size, moves);
            }
            if (is_good) values -= rest;
        }
        for (Index k = 0; k < moves && is_good; ++k) {
            modes.push_back({found.col(k), freedoms.columns.col(k)});
        }
    }
    for (Index k = moves; k < count; ++k) {
        modes.push_back({freedoms.columns.col(k), freedoms.columns.col(k)});
    }
    return modes;
}

}  // namespace cascade::continuation
