// The effect of the discrete operators of the language on a wave.
//
// Each multiplies the wave exp(i θ·n), where n is the number of the cell along each axis, by a
// factor, its symbol. Nested operators multiply their symbols, so a linear formula is a sum of
// products of these few.
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

/// A wave by its phase from one cell to the next along each axis, in radians.
using Phases = std::array<double, 3>;

/// The weights of a convolution, in the box around all lags.
class WaveKernel {
public:
    explicit WaveKernel(const WeightedLags& weighted);

    /// Σ weight · exp(i θ·lag), by which a convolution multiplies the wave exp(i θ·n).
    Complex symbol(const Phases& phases) const;
    /// The sum of all weights.
    double sum() const { return sum_; }

private:
    std::array<std::int64_t, 3> low_{}, size_{};  ///< The box, along each axis.
    std::vector<double> weights_;                 ///< For all lags in the box: x first, z last.
    double magnitude_ = 0;                        ///< The magnitude of all weights together.
    double sum_ = 0;
};

/// A model's kernels, by their numbers.
using WaveKernels = std::vector<std::shared_ptr<const WaveKernel>>;

/// A difference along an axis or of all axes, as the stencil of the domain has it, or another
/// operator.
struct WaveOperator {
    // clang-format off
    enum class Kind : std::uint8_t {
        difference,
        mean,         ///< Over the domain: 1 for a change that is the same in all cells, else 0.
        convolution,  ///< With a kernel, whose number is in place of an axis.
    };
    // clang-format on
    Kind kind = Kind::difference;
    Difference difference = Difference::laplacian;
    std::uint8_t axis = 0;

    friend auto operator<=>(const WaveOperator&, const WaveOperator&) = default;
};

/// Successive operators in increasing order, since their order does not matter. Empty: the value
/// itself.
using OperatorProduct = std::vector<WaveOperator>;
OperatorProduct followed_by(OperatorProduct first, WaveOperator then);

/// The cells that carry waves.
struct Lattice {
    double spacing = 1;              ///< Between the centres of neighbours, in the script's unit.
    std::array<bool, 3> has_axis{};  ///< Whether the grid has several cells along it.
    std::array<double, 3> cells{};   ///< The number of cells along each axis. 0 if unknown.
    std::array<bool, 3> is_periodic{};
    /// Whether there are no axes, as on a model or a curved surface. Then derivatives are those of
    /// calculus: lap is −k², along a first axis in place of any direction.
    bool is_continuous = false;
    StencilKind stencil = StencilKind::cross;
};
Lattice lattice_of(const Program& program);

/// `kernels` are referred to by number in the operators.
Complex symbol(const OperatorProduct& operators, const Lattice& lattice, const WaveKernels& kernels,
               const Phases& phases);

}  // namespace cascade::analysis
