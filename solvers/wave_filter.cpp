// Computes the factors of a line of waves, then multiplies the line by them.
#include "solvers/wave_filter.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// The responses of one line of waves, divided by the gain of the transforms.
template <typename Number>
void respond(const WaveBlock<Number>& block, std::int64_t line, const DiffusionTerms<Number>& f,
             WaveResponse response, std::vector<Number>& factors) {
    const Number* const along = block.differences[block.axis];
    Number q_of_rest = 0, of_rest = 0;
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
        if (axis == block.axis) continue;
        const Number difference = block.differences[axis][axis == 0 ? line : 0];
        q_of_rest -= difference;
        of_rest += f[laplacian_powers + axis] * difference;
    }
    const Number of_axis = f[laplacian_powers + block.axis];
    const auto part = static_cast<Number>(1 / block.gain);
    factors.resize(static_cast<std::size_t>(block.count));
    Number* const found = factors.data();
    for (std::int64_t n = 0; n < block.count; ++n) {
        const Number q = q_of_rest - along[n];
        const Number of_axes = of_axis * along[n] + of_rest;
        const Number change = of_axes - q * (f[0] + q * (f[1] + q * (f[2] + q * f[3])));
        const Number damping = change < 0 ? -change : Number{0};
        if (response == WaveResponse::implicit) {
            found[n] = part / (1 + damping);
        } else {
            found[n] = damping > 0 ? part * (-std::expm1(-damping) / damping) : part;
        }
    }
}

template <typename Number>
void multiply(const WaveBlock<Number>& block, std::int64_t line,
              const std::vector<Number>& factors) {
    const std::int64_t parts = block.is_complex ? 2 : 1;
    Number* const waves = block.waves[0] + line * block.count * parts;
    const Number* const by = factors.data();
    if (block.is_complex) {
        for (std::int64_t n = 0; n < block.count; ++n) {
            waves[2 * n] *= by[n];
            waves[2 * n + 1] *= by[n];
        }
    } else {
        for (std::int64_t n = 0; n < block.count; ++n) waves[n] *= by[n];
    }
}

}  // namespace

template <typename Number>
void WaveFilter<Number>::apply(Team& team, int thread, int threads, std::span<Number* const> planes,
                               std::span<const DiffusionSymbol> symbols, WaveResponse response,
                               double length) const {
    // Species without diffusion do not change.
    std::vector<Number*> filtered(planes.begin(), planes.end());
    std::vector<DiffusionTerms<Number>> scaled(planes.size());
    for (std::size_t s = 0; s < planes.size(); ++s) {
        const auto is_none = [](double factor) { return factor == 0; };
        if (std::all_of(symbols[s].begin(), symbols[s].end(), is_none)) filtered[s] = nullptr;
        for (std::size_t n = 0; n < diffusion_terms; ++n) {
            scaled[s][n] = static_cast<Number>(length * symbols[s][n]);
        }
    }
    const std::span<Number* const> to[] = {planes};
    std::vector<Number> factors;
    transforms_.apply(team, thread, threads, filtered, to, [&](const WaveBlock<Number>& block) {
        for (std::int64_t line = 0; line < block.lines; ++line) {
            respond(block, line, scaled[block.species], response, factors);
            multiply(block, line, factors);
        }
    });
}

template class WaveFilter<float>;
template class WaveFilter<double>;

}  // namespace cascade
