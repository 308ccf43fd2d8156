// Symbols of the differences of lang/program/stencils.cpp in closed form, because they are computed
// for many waves. tests/unit/analysis/stencils_test.cpp compares them with the weights.
#include "analysis/wave_operators.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

namespace cascade::analysis {

namespace {

std::array<std::int64_t, 3> by_axis(const Lag& lag) { return {lag.x, lag.y, lag.z}; }

using Kind = WaveOperator::Kind;

double second_difference(const Lattice& lattice, double phase) {
    const double h = lattice.spacing;
    if (lattice.is_continuous) return -(phase * phase) / (h * h);
    const double sine = std::sin(phase / 2);
    return -4 * sine * sine / (h * h);
}

/// The same difference as in lang/lower/stencil_pass.cpp.
double second_derivative(const Lattice& lattice, double phase) {
    const double plain = second_difference(lattice, phase), h = lattice.spacing;
    if (lattice.is_continuous || lattice.stencil != StencilKind::fourth) return plain;
    return plain * (1 - h * h / 12 * plain);
}

double laplacian(const Lattice& lattice, const Phases& phases) {
    double sum = 0, pairs = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!lattice.has_axis[axis]) continue;
        const double along = second_derivative(lattice, phases[axis]);
        pairs += sum * along;
        sum += along;
    }
    if (lattice.is_continuous || lattice.stencil != StencilKind::isotropic) return sum;
    return sum + lattice.spacing * lattice.spacing / 6 * pairs;
}

Complex symbol_of(WaveOperator each, const Lattice& lattice, const WaveKernels& kernels,
                  const Phases& phases) {
    if (each.kind == Kind::convolution) return kernels[each.axis]->symbol(phases);
    const double h = lattice.spacing, phase = phases[each.axis];
    const Complex i(0, 1);
    if (each.kind == Kind::mean) return phases == Phases{} ? 1.0 : 0.0;
    switch (each.difference) {
        case Difference::laplacian: return laplacian(lattice, phases);
        case Difference::average:
            return lattice.is_continuous || !lattice.has_axis[each.axis] ? 1 : std::cos(phase / 2);
        default: break;
    }
    if (!lattice.has_axis[each.axis]) return 0;
    if (each.difference == Difference::second) return second_derivative(lattice, phase);
    if (lattice.is_continuous) return i * phase / h;
    switch (each.difference) {
        case Difference::central: {
            const bool is_fourth = lattice.stencil == StencilKind::fourth;
            const double less = is_fourth ? h * h / 6 * second_difference(lattice, phase) : 0;
            return i * std::sin(phase) / h * (1 - less);
        }
        case Difference::across: return 2.0 * i * std::sin(phase / 2) / h;
        case Difference::backward: return (1.0 - std::exp(-i * phase)) / h;
        case Difference::forward: return (std::exp(i * phase) - 1.0) / h;
        default: break;
    }
    CHECK(false, "every difference of rates has a symbol");
}

}  // namespace

WaveKernel::WaveKernel(const WeightedLags& weighted) {
    std::array<std::int64_t, 3> high{};
    for (const Lag& lag : weighted.lags) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low_[axis] = std::min(low_[axis], by_axis(lag)[axis]);
            high[axis] = std::max(high[axis], by_axis(lag)[axis]);
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) size_[axis] = high[axis] - low_[axis] + 1;
    weights_.assign(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]), 0.0);
    for (std::size_t n = 0; n < weighted.lags.size(); ++n) {
        const auto [x, y, z] = by_axis(weighted.lags[n]);
        const std::int64_t row = (z - low_[2]) * size_[1] + (y - low_[1]);
        weights_[static_cast<std::size_t>(row * size_[0] + x - low_[0])] += weighted.weights[n];
        magnitude_ += std::abs(weighted.weights[n]);
    }
    sum_ = symbol({}).real();
}

Complex WaveKernel::symbol(const Phases& phases) const {
    const auto columns = static_cast<std::size_t>(size_[0]);
    std::vector<double> real(columns, 0.0), imaginary(columns, 0.0);
    const double* weight = weights_.data();
    const auto first = [&](std::size_t axis) {
        return std::polar(1.0, phases[axis] * static_cast<double>(low_[axis]));
    };
    const Complex across = std::polar(1.0, phases[0]), down = std::polar(1.0, phases[1]);
    for (std::int64_t z = 0; z < size_[2]; ++z) {
        Complex wave = first(1) * std::polar(1.0, phases[2] * static_cast<double>(low_[2] + z));
        for (std::int64_t y = 0; y < size_[1]; ++y) {
            const double cosine = wave.real(), sine = wave.imag();
            for (std::size_t k = 0; k < columns; ++k) {
                real[k] += weight[k] * cosine;
                imaginary[k] += weight[k] * sine;
            }
            weight += columns;
            wave *= down;
        }
    }
    Complex sum = 0, wave = first(0);
    for (std::size_t k = 0; k < columns; ++k) {
        sum += wave * Complex(real[k], imaginary[k]);
        wave *= across;
    }
    // If weights are symmetric, the imaginary part is only a rounding error.
    return std::abs(sum.imag()) > 1e-12 * magnitude_ ? sum : Complex(sum.real());
}

OperatorProduct followed_by(OperatorProduct first, WaveOperator then) {
    // The mean of a mean is the same mean, so it is listed once. The mean of a difference is 0,
    // which follows from the symbol of the mean.
    if (then.kind == Kind::mean && std::find(first.begin(), first.end(), then) != first.end()) {
        return first;
    }
    first.insert(std::upper_bound(first.begin(), first.end(), then), then);
    return first;
}

namespace {

/// The mean distance of cells on a surface with this longest side, as if it were a sphere. 1 if the
/// unit of length is the mean distance.
double mean_distance(std::optional<double> extent, std::int64_t cells) {
    return extent ? *extent * std::sqrt(std::numbers::pi / static_cast<double>(cells)) : 1;
}

}  // namespace

Lattice lattice_of(const Program& program) {
    const DomainSettings& domain = program.domain;
    const Grid& grid = domain.grid;
    Lattice lattice;
    if (domain.model) {
        lattice.spacing = mean_distance(domain.model->extent, domain.model->count);
        lattice.is_continuous = true;
        lattice.has_axis = {true, false, false};
        return lattice;
    }
    lattice.spacing = grid.spacing;
    lattice.stencil = domain.stencil;
    const Stencil stencil = grid.stencil();
    lattice.has_axis = {stencil.x, stencil.y, stencil.z};
    lattice.cells = {static_cast<double>(grid.width), static_cast<double>(grid.height),
                     static_cast<double>(grid.depth)};
    lattice.is_periodic = {grid.boundary.x == Boundary::periodic,
                           grid.boundary.y == Boundary::periodic,
                           grid.boundary.z == Boundary::periodic};
    if (domain.surface && domain.surface->has_metric) {
        lattice.spacing = mean_distance(domain.surface->extent, grid.cell_count());
        lattice.is_continuous = true;
        lattice.has_axis = {true, false, false};
        lattice.cells = {};
    }
    return lattice;
}

Complex symbol(const OperatorProduct& operators, const Lattice& lattice, const WaveKernels& kernels,
               const Phases& phases) {
    Complex product = 1;
    for (const WaveOperator each : operators) product *= symbol_of(each, lattice, kernels, phases);
    return product;
}

}  // namespace cascade::analysis
