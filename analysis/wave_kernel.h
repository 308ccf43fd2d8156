// What a convolution does to a wave: the Fourier transform of its weights.
#pragma once

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

}  // namespace cascade::analysis
