// What the discrete operators of the language do to a wave.
//
// Each of them multiplies the wave exp(i θ·n), n being the number of the cell along each axis, by a
// factor, its symbol. Operators within operators multiply theirs, so a linear formula is a sum of
// products of these few.
#pragma once

#include "core/grid.h"
#include "lang/program/program.h"
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
    std::array<std::int64_t, 3> low_{}, size_{};  ///< Of the box, along each axis.
    std::vector<double> weights_;                 ///< Of all lags in the box: x first, z last.
    double magnitude_ = 0;                        ///< Of all weights together.
    double sum_ = 0;
};

/// Those of a model, by their numbers.
using WaveKernels = std::vector<std::shared_ptr<const WaveKernel>>;

/// An operator along an axis, or one of all axes.
struct WaveOperator {
    // clang-format off
    enum class Kind : std::uint8_t {
        laplacian,  ///< The sum of the second differences along all axes.
        second,     ///< (E − 2c + W) / h².
        central,    ///< (E − W) / 2h. These three as the stencil of the domain has them.
        across,     ///< (E − c) / h at the face between them, and the same from faces to cells.
        average,    ///< (c + E) / 2 at the face.
        backward,   ///< (c − W) / h, of a flow along the axis.
        forward,    ///< (E − c) / h, of a flow against it.
        mean,       ///< Over the domain: 1 for a change that is the same in all cells, else 0.
        convolution,  ///< With a kernel, whose number is in place of an axis.
    };
    // clang-format on
    Kind kind = Kind::laplacian;
    std::uint8_t axis = 0;

    friend auto operator<=>(const WaveOperator&, const WaveOperator&) = default;
};

/// Operators one after the other, in increasing order, since their order does not matter. Empty:
/// the value itself.
using OperatorProduct = std::vector<WaveOperator>;
OperatorProduct followed_by(OperatorProduct first, WaveOperator then);

/// The cells on which waves are.
struct Lattice {
    double spacing = 1;              ///< Between the centres of neighbours, in the script's unit.
    std::array<bool, 3> has_axis{};  ///< Does the grid have several cells along it?
    std::array<double, 3> cells{};   ///< The number of cells along each axis; 0 if unknown.
    std::array<bool, 3> is_periodic{};
    /// Are there no axes, as on a model or a curved surface? Then derivatives are those of
    /// calculus: lap is −k², along a first axis in place of any direction.
    bool is_continuous = false;
    StencilKind stencil = StencilKind::cross;
};
Lattice lattice_of(const Program& program);

/// `kernels` are those that the operators name by their numbers.
Complex symbol(const OperatorProduct& operators, const Lattice& lattice, const WaveKernels& kernels,
               const Phases& phases);

}  // namespace cascade::analysis
