// Computes the factors of a line of waves, then multiplies the line by them.
#include "solvers/wave_filter.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// Multiplies every wave by its response.
template <typename Number>
void respond(const WaveBlock<Number>& block, const DiffusionTerms<Number>& f, WaveResponse response,
             std::vector<Number>& factors) {
    const auto part = static_cast<Number>(1 / block.gain);
    for (std::int64_t line = 0; line < block.lines; ++line) {
        find_damping(block, line, f, factors);
        Number* const by = factors.data();
        if (response == WaveResponse::implicit) {
            for (std::int64_t n = 0; n < block.count; ++n) by[n] = part / (1 + by[n]);
        } else {
            for (std::int64_t n = 0; n < block.count; ++n) {
                by[n] = by[n] > 0 ? part * (-std::expm1(-by[n]) / by[n]) : part;
            }
        }
        if (block.is_complex) {
            Number* const waves = block.waves[0] + 2 * line * block.count;
            for (std::int64_t n = 0; n < block.count; ++n) {
                waves[2 * n] *= by[n];
                waves[2 * n + 1] *= by[n];
            }
        } else {
            Number* const waves = block.waves[0] + line * block.count;
            for (std::int64_t n = 0; n < block.count; ++n) waves[n] *= by[n];
        }
    }
}

}  // namespace

template <typename Number>
void WaveFilter<Number>::apply(Team& team, int thread, int threads, const FilteredPlanes& planes,
                               std::span<const DiffusionSymbol> symbols, WaveResponse response,
                               double length, const std::atomic<bool>* cancel) const {
    std::vector<bool> has_diffusion;
    std::vector<DiffusionTerms<Number>> scaled(symbols.size());
    for (std::size_t s = 0; s < symbols.size(); ++s) {
        has_diffusion.push_back(std::any_of(symbols[s].begin(), symbols[s].end(),
                                            [](double factor) { return factor != 0; }));
        for (std::size_t n = 0; n < diffusion_terms; ++n) {
            scaled[s][n] = static_cast<Number>(length * symbols[s][n]);
        }
    }
    std::vector<std::span<Number* const>> to{planes.filtered};
    if (!planes.error.empty()) to.emplace_back(planes.error);
    std::vector<Number> scratch;
    const auto act = [&](const WaveBlock<Number>& block) {
        const std::size_t s = block.species;
        if (planes.kept.empty()) {
            if (has_diffusion[s]) respond(block, scaled[s], response, scratch);
            return;
        }
        EtdMemory<Number> memory;
        for (std::size_t k = 0; k < memory.size(); ++k) {
            memory[k] = planes.kept[k][s] + block.offset;
        }
        take_etd_stage(block, scaled[s], response, memory, scratch);
    };
    transforms_.apply(team, thread, threads, has_diffusion, to, act, cancel);
}

template class WaveFilter<float>;
template class WaveFilter<double>;

}  // namespace cascade
