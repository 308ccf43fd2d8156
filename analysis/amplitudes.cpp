// The second and third derivatives are differences of the exact Jacobian, extrapolated to a step of
// 0.
#include "analysis/amplitudes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace cascade::analysis {

namespace {

/// Relative changes and relative products below these limits count as 0, because differences have
/// errors.
constexpr double no_change = 1e-6, no_product = 1e-6;

/// The rates as a polynomial of the change of the state: f(u) = J u + ½ Q(u, u) + ⅙ C(u, u, u).
class RatePolynomial {
public:
    RatePolynomial(const LocalRates& rates, const Vector& state)
        : rates_(rates), state_(state), size_(std::max(state.cwiseAbs().maxCoeff(), 0.01)) {}

    /// The value of Q(a, b).
    Vector second(const Vector& a, const Vector& b) const {
        const auto change = [&](double step) {
            return Vector((local(a * step) - local(a * -step)) * b / (2 * step));
        };
        return extrapolated(change, a);
    }
    /// The value of C(a, a, b).
    Vector third(const Vector& a, const Vector& b) const {
        const Vector middle = local(Vector::Zero(state_.size())) * b;
        const auto change = [&](double step) {
            return Vector(((local(a * step) + local(a * -step)) * b - 2 * middle) / (step * step));
        };
        return extrapolated(change, a);
    }
    /// Whether those terms of the Jacobian that read other cells stay constant along this
    /// direction.
    bool is_local(const Vector& direction) const {
        const double step = 0.01 * size_ / direction.cwiseAbs().maxCoeff();
        const Matrices here = rates_.matrices(state_),
                       there = rates_.matrices(state_ + direction * step);
        for (std::size_t k = 1; k < here.terms.size(); ++k) {
            const double size = here.terms[k].cwiseAbs().maxCoeff();
            const double moved = (there.terms[k] - here.terms[k]).cwiseAbs().maxCoeff();
            if (!(moved <= no_change * size)) return false;
        }
        return true;
    }

private:
    Matrix local(const Vector& change) const { return rates_.matrices(state_ + change).terms[0]; }

    /// Extrapolates differences of second order to sixth order.
    template <typename Change>
    Vector extrapolated(const Change& change, const Vector& direction) const {
        const double step = 0.02 * size_ / direction.cwiseAbs().maxCoeff();
        const Vector whole = change(step), half = change(step / 2), quarter = change(step / 4);
        const Vector first = (4 * half - whole) / 3, second = (4 * quarter - half) / 3;
        return (16 * second - first) / 15;
    }

    const LocalRates& rates_;
    const Vector& state_;
    double size_;
};

/// The critical wave and its adjoint, with ψ · φ = 1.
struct Critical {
    Vector wave, adjoint;
};

std::optional<Critical> critical_wave(const Matrix& jacobian, double resolution) {
    const auto null_vector = [&](const Matrix& matrix) -> std::optional<Vector> {
        EigenPair nearest = least_eigenpair(matrix);
        if (std::abs(nearest.value.imag()) > resolution) return std::nullopt;
        return std::move(nearest.vector);
    };
    const auto wave = null_vector(jacobian), adjoint = null_vector(jacobian.transpose());
    if (!wave || !adjoint) return std::nullopt;
    Eigen::Index largest = 0;
    wave->cwiseAbs().maxCoeff(&largest);
    const Vector scaled = *wave / (*wave)[largest];
    const double product = adjoint->dot(scaled);
    if (!(std::abs(product) > 0)) return std::nullopt;
    return Critical{scaled, *adjoint / product};
}

/// The x with L x = −f, where L is `matrix` and f is `forcing`.
Vector answer(const Matrix& matrix, const Vector& forcing) { return -solution_of(matrix, forcing); }

/// The response of the wave k₁ + k₂ = −k₃ to the product of two waves. The part of the forcing
/// along the critical wave gives the quadratic coefficient. This function gives the response to the
/// rest of the forcing.
Vector resonant_answer(const Matrix& at_wave, const Critical& critical, const Vector& square) {
    const auto& [wave, adjoint] = critical;
    Matrix bordered = Matrix::Zero(wave.size() + 1, wave.size() + 1);
    bordered.topLeftCorner(wave.size(), wave.size()) = at_wave;
    bordered.topRightCorner(wave.size(), 1) = wave;
    bordered.bottomLeftCorner(1, wave.size()) = adjoint.transpose();
    Vector forcing = Vector::Zero(wave.size() + 1);
    forcing.head(wave.size()) = square - wave * adjoint.dot(square);
    return answer(bordered, forcing).head(wave.size());
}

}  // namespace

bool AmplitudeEquations::has_plane() const { return !std::isnan(cross); }

double AmplitudeEquations::rate_of_stripes() const {
    return quadratic * quadratic * self / ((cross - self) * (cross - self));
}

std::optional<AmplitudeEquations> amplitude_equations(const LocalRates& rates, const Vector& state,
                                                      const Dispersion& relation) {
    const LinearModel& model = rates.model();
    const Lattice lattice = lattice_of(*model.program);
    const Matrices matrices = rates.matrices(state);
    if (!model.unknowns.empty() || relation.depends_on_direction || !matrices.are_finite()) {
        return std::nullopt;
    }
    const double phase = relation.fastest.phase;
    const std::size_t axes = static_cast<std::size_t>(
        std::count(lattice.has_axis.begin(), lattice.has_axis.end(), true));
    const bool has_plane = lattice.is_continuous || axes >= 2;
    // The waves are along the first two axes that exist. A continuous lattice has only one axis,
    // which represents all directions.
    const auto wave_at = [&](double across, double up) {
        Phases phases{};
        if (lattice.is_continuous) {
            phases[0] = std::hypot(across, up);
        } else {
            std::size_t next = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!lattice.has_axis[axis]) continue;
                phases[axis] = next == 0 ? across : next == 1 ? up : 0;
                ++next;
            }
        }
        return jacobian_of(model, matrices, lattice, phases);
    };
    const auto at = [&](double across, double up) { return Matrix(wave_at(across, up).real()); };
    const ComplexMatrix critical_jacobian = wave_at(phase, 0);
    const Matrix at_wave = critical_jacobian.real();
    const double size = at_wave.cwiseAbs().maxCoeff();
    const auto critical = critical_wave(at_wave, 1e-6 * size);
    // If waves travel, the coefficients are complex.
    const double travels = critical_jacobian.imag().cwiseAbs().maxCoeff();
    if (!critical || travels > 1e-9 * size) return std::nullopt;
    const auto& [wave, adjoint] = *critical;
    const RatePolynomial polynomial(rates, state);
    if (!polynomial.is_local(wave)) return std::nullopt;
    const Matrix at_rest = at(0, 0);
    if (least_pivot(at_rest) <= 1e-9 * size) return std::nullopt;

    const Vector square = polynomial.second(wave, wave), cube = polynomial.third(wave, wave);
    const double largest =
        (adjoint.cwiseAbs().array() * square.cwiseAbs().array()).sum() + no_product * size;
    AmplitudeEquations result;
    result.wave = wave;
    result.quadratic = adjoint.dot(square);
    if (std::abs(result.quadratic) <= no_product * largest) result.quadratic = 0;
    const auto by = [&](const Vector& mode) { return adjoint.dot(polynomial.second(wave, mode)); };
    const double from_mean = by(answer(at_rest, square));
    result.self = -(from_mean + by(answer(at(2 * phase, 0), square / 2)) + adjoint.dot(cube) / 2);
    result.cross = std::numeric_limits<double>::quiet_NaN();
    if (!has_plane) return result;
    // k₁ − k₂ is √3 times as long as k₁.
    const double root = std::numbers::sqrt3;
    result.cross = -(from_mean + by(answer(at(1.5 * phase, root / 2 * phase), square)) +
                     by(resonant_answer(at_wave, *critical, square)) + adjoint.dot(cube));
    return result;
}

}  // namespace cascade::analysis
