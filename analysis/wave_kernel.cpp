// Sums the rows first, column by column, so that the inner loop is one of vectors.
#include "analysis/wave_kernel.h"

#include <algorithm>
#include <cmath>

namespace cascade::analysis {

namespace {

std::array<std::int64_t, 3> by_axis(const Lag& lag) { return {lag.x, lag.y, lag.z}; }

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
    // Weights that are the same to both sides leave rounding errors only.
    return std::abs(sum.imag()) > 1e-12 * magnitude_ ? sum : Complex(sum.real());
}

}  // namespace cascade::analysis
