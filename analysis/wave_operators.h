// The effect of the discrete operators of the language on a wave.
//
// Each operator multiplies the wave exp(i θ·n), where n is the number of the cell along each axis,
// by a factor, its symbol. The symbol of nested operators is the product of their symbols. So the
// symbol of a linear formula is a sum of products of these few symbols.
#pragma once

#include "core/grid.h"
#include "lang/program/stencils.h"
#include "solvers/convolution.h"

#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

namespace cascade::analysis {

using Complex = std::complex<double>;

/// A wave, given by its phase from one cell to the next along each axis, in radians.
using Phases = std::array<double, 3>;

/// The weights of a convolution, in the box around all lags.
class WaveKernel {
public:
    explicit WaveKernel(const WeightedLags& weighted);

    /// Σ weight · exp(i θ·lag), the factor by which a convolution multiplies the wave exp(i θ·n).
    Complex symbol(const Phases& phases) const;
    /// The sum of all weights.
    double sum() const { return sum_; }

private:
    /// The box of lags: its lower corner and its size along each axis.
    std::array<std::int64_t, 3> low_{}, size_{};
    /// The weights of all lags in the box. x varies fastest, z slowest.
    std::vector<double> weights_;
    double magnitude_ = 0;  ///< The sum of the magnitudes of all weights.
    double sum_ = 0;
};

/// The kernels of a model, by index.
using WaveKernels = std::vector<std::shared_ptr<const WaveKernel>>;

/// A discrete operator, such as a difference along one axis or along all axes by the stencil of the
/// domain.
struct WaveOperator {
    // clang-format off
    enum class Kind : std::uint8_t {
        difference,
        mean,  ///< The mean over the domain: 1 for a change that is the same in all cells, else 0.
        convolution,  ///< A convolution. Its kernel's index is in `axis`.
    };
    // clang-format on
    Kind kind = Kind::difference;
    Difference difference = Difference::laplacian;
    std::uint8_t axis = 0;

    friend auto operator<=>(const WaveOperator&, const WaveOperator&) = default;
};

/// A product of operators. The order of the operators does not change the product, so they are
/// sorted in increasing order. An empty product leaves a value unchanged.
using OperatorProduct = std::vector<WaveOperator>;
OperatorProduct followed_by(OperatorProduct first, WaveOperator then);

/// The cells on which waves exist.
struct Lattice {
    /// The distance between the centres of neighbouring cells, in the script's unit.
    double spacing = 1;
    std::array<bool, 3> has_axis{};  ///< Whether the grid has several cells along each axis.
    std::array<double, 3> cells{};   ///< The number of cells along each axis; 0 if unknown.
    std::array<bool, 3> is_periodic{};
    /// Whether there are no axes, as on a model or a curved surface. Derivatives are then exact
    /// (lap is −k²), and the first axis represents all directions.
    bool is_continuous = false;
    StencilKind stencil = StencilKind::cross;
};
Lattice lattice_of(const Program& program);

/// The symbol of a product of operators. Convolutions refer to `kernels` by index.
Complex symbol(const OperatorProduct& operators, const Lattice& lattice, const WaveKernels& kernels,
               const Phases& phases);

}  // namespace cascade::analysis
