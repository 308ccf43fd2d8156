#include "tests/models/dispersion.h"

#include <algorithm>
#include <cmath>

namespace cascade::models {

namespace {

using Matrix = std::vector<State>;

Matrix jacobian(const ReactionDiffusion& system, const State& at) {
    const std::size_t count = at.size();
    Matrix result(count, State(count));
    for (std::size_t column = 0; column < count; ++column) {
        const double shift = 1e-6 * (1 + std::abs(at[column]));
        State above = at, below = at;
        above[column] += shift;
        below[column] -= shift;
        const State high = system.reaction(above), low = system.reaction(below);
        for (std::size_t row = 0; row < count; ++row) {
            result[row][column] = (high[row] - low[row]) / (2 * shift);
        }
    }
    return result;
}

Matrix product(const Matrix& a, const Matrix& b) {
    const std::size_t count = a.size();
    Matrix result(count, State(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            for (std::size_t k = 0; k < count; ++k) result[i][j] += a[i][k] * b[k][j];
        }
    }
    return result;
}

double largest_entry(const Matrix& matrix) {
    double largest = 0;
    for (const State& row : matrix) {
        for (const double entry : row) largest = std::max(largest, std::abs(entry));
    }
    return largest;
}

/// Solves matrix · x = right by elimination with pivoting.
State solve(Matrix matrix, State right) {
    const std::size_t count = right.size();
    for (std::size_t column = 0; column < count; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column; row < count; ++row) {
            if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) pivot = row;
        }
        std::swap(matrix[pivot], matrix[column]);
        std::swap(right[pivot], right[column]);
        for (std::size_t row = 0; row < count; ++row) {
            if (row == column) continue;
            const double factor = matrix[row][column] / matrix[column][column];
            for (std::size_t k = column; k < count; ++k) {
                matrix[row][k] -= factor * matrix[column][k];
            }
            right[row] -= factor * right[column];
        }
    }
    for (std::size_t row = 0; row < count; ++row) right[row] /= matrix[row][row];
    return right;
}

}  // namespace

State flat_state(const ReactionDiffusion& system, State guess) {
    for (int round = 0; round < 50; ++round) {
        const State step = solve(jacobian(system, guess), system.reaction(guess));
        for (std::size_t i = 0; i < guess.size(); ++i) guess[i] -= step[i];
    }
    return guess;
}

/// log |exp(A t)| grows with t in proportion to the wanted real part. exp(A t) is computed by its
/// series for small t and then squared repeatedly. After each squaring it is divided by its norm,
/// so that nothing overflows.
double growth_rate(const ReactionDiffusion& system, const State& flat, double square_of_k) {
    Matrix matrix = jacobian(system, flat);
    const std::size_t count = flat.size();
    for (std::size_t i = 0; i < count; ++i) matrix[i][i] -= square_of_k * system.diffusion[i];
    const double time = 0.1 / (1 + largest_entry(matrix));
    Matrix term(count, State(count)), power(count, State(count));
    for (std::size_t i = 0; i < count; ++i) term[i][i] = power[i][i] = 1;
    for (int order = 1; order <= 12; ++order) {
        term = product(term, matrix);
        for (State& row : term) {
            for (double& entry : row) entry *= time / order;
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) power[i][j] += term[i][j];
        }
    }
    double logarithm = 0;
    constexpr int doublings = 40;
    for (int round = 0; round < doublings; ++round) {
        power = product(power, power);
        const double size = largest_entry(power);
        logarithm = 2 * logarithm + std::log(size);
        for (State& row : power) {
            for (double& entry : row) entry /= size;
        }
    }
    return logarithm / (time * std::ldexp(1, doublings));
}

double fastest_wave(const ReactionDiffusion& system, const State& flat, double most) {
    double best = 0, rate = growth_rate(system, flat, 0);
    constexpr int parts = 4000;
    for (int i = 1; i <= parts; ++i) {
        const double square = most * i / parts;
        const double here = growth_rate(system, flat, square);
        if (here > rate) {
            rate = here;
            best = square;
        }
    }
    return best;
}

}  // namespace cascade::models
