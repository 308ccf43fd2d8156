// φ₁(z) = (e^z − 1)/z and φ_{k+1}(z) = (φ_k(z) − 1/k!)/z suffer from cancellation if z is small. So
// the functions are computed at z/2⁸ by their series, and their arguments are doubled eight times
// by
//
//     φ_k(2z) = 2^−k (e^z φ_k(z) + Σ_{j=1}^{k} φ_j(z)/(k − j)!),
//
// where all terms are positive. Below z = −64, e^z is 0 and nothing cancels.
#include "solvers/etd_stages.h"

#include <algorithm>
#include <type_traits>

namespace cascade {
namespace {

/// Computes φ₁, φ₂ and φ₃ of −damping/2. Loops are short, so that compilers vectorise them.
template <typename Number>
void find_phi(const std::vector<Number>& damping, Number* __restrict phi1, Number* __restrict phi2,
              Number* __restrict phi3) {
    constexpr int doublings = 8, terms = std::is_same_v<Number, float> ? 4 : 9;
    constexpr Number most = 64;
    const auto count = static_cast<std::ptrdiff_t>(damping.size());
    const Number* const of_wave = damping.data();
    std::vector<Number> shortened(damping.size());
    Number* const z = shortened.data();
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        z[n] = std::min(of_wave[n] / 2, most) * (Number{-1} / (1 << doublings));
    }
    for (std::ptrdiff_t n = 0; n < count; ++n) phi3[n] = 1;
    // φ₃(z) = 1/3! (1 + z/4 (1 + z/5 (1 + …)))
    for (int k = terms; k > 0; --k) {
        const Number part = 1 / static_cast<Number>(3 + k);
        for (std::ptrdiff_t n = 0; n < count; ++n) {
            phi3[n] = 1 + z[n] * part * phi3[n];
        }
    }
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        phi3[n] /= 6;
        phi2[n] = Number{0.5} + z[n] * phi3[n];
        phi1[n] = 1 + z[n] * phi2[n];
    }
    for (int k = 0; k < doublings; ++k) {
        for (std::ptrdiff_t n = 0; n < count; ++n) {
            const Number p1 = phi1[n], p2 = phi2[n];
            phi3[n] = (p1 * p2 + p2 + 2 * phi3[n]) / 8;
            phi2[n] = (p1 * p1 + 2 * p2) / 4;
            phi1[n] = p1 * (2 + z[n] * p1) / 2;
            z[n] *= 2;
        }
    }
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        const Number x = of_wave[n] / 2;
        const Number p1 = 1 / (x > most ? x : most);
        const Number p2 = (1 - p1) * p1, p3 = (Number{0.5} - p2) * p1;
        phi1[n] = x > most ? p1 : phi1[n];
        phi2[n] = x > most ? p2 : phi2[n];
        phi3[n] = x > most ? p3 : phi3[n];
    }
}

/// A line of waves. A wave has `parts` elements.
template <typename Number>
struct Line {
    Number* rate;
    Number* error;  ///< May be null.
    Number *first, *second, *third;
    const Number *phi1, *phi2, *phi3;
};

template <int parts, typename Number>
void take_stage(const Line<Number>& at, const std::vector<Number>& damping, WaveResponse response,
                Number part) {
    const auto count = static_cast<std::ptrdiff_t>(damping.size());
    const Number* const x = damping.data();
    const auto for_waves = [&](const auto& act) {
        for (std::ptrdiff_t n = 0; n < count; ++n) {
            // The functions at z/2, with e = exp(z/2).
            const Number p1 = at.phi1[n], p2 = at.phi2[n], e = 1 - x[n] / 2 * p1;
            for (int c = 0; c < parts; ++c) act(n, n * parts + c, p1, p2, e);
        }
    };
    const auto whole1 = [](Number p1, Number e) { return p1 * (1 + e) / 2; };
    const auto whole2 = [](Number p1, Number p2) { return (p1 * p1 + 2 * p2) / 4; };
    switch (response) {
        case WaveResponse::etd_second:
            return for_waves([&](std::ptrdiff_t, std::ptrdiff_t i, Number p1, Number p2, Number e) {
                const Number d = at.rate[i] - e * at.first[i];
                at.second[i] = d;
                at.rate[i] = part * (p1 / 2 * at.first[i] + p2 * d);
            });
        case WaveResponse::etd_third:
            return for_waves(
                [&](std::ptrdiff_t n, std::ptrdiff_t i, Number p1, Number p2, Number e) {
                    const Number d = at.rate[i] - e * at.first[i] + x[n] * p2 * at.second[i];
                    at.third[i] = d;
                    at.rate[i] = part * (whole1(p1, e) * at.first[i] + 2 * whole2(p1, p2) * d);
                });
        case WaveResponse::etd_last:
            return for_waves([&](std::ptrdiff_t n, std::ptrdiff_t i, Number p1, Number p2,
                                 Number e) {
                const Number second = whole2(p1, p2), third = (p1 * p2 + p2 + 2 * at.phi3[n]) / 8;
                const Number d = at.rate[i] - e * e * at.first[i] + 2 * x[n] * second * at.third[i];
                const Number middle = 2 * second - 4 * third, last = 4 * third - second;
                at.rate[i] = part * (whole1(p1, e) * at.first[i] +
                                     middle * (at.second[i] + at.third[i]) + last * d);
                if (at.error == nullptr) return;
                at.error[i] =
                    part * (middle * at.second[i] + (middle - 2 * second) * at.third[i] + last * d);
            });
        default:
            return for_waves([&](std::ptrdiff_t, std::ptrdiff_t i, Number p1, Number, Number) {
                at.first[i] = at.rate[i];
                at.rate[i] = part * (p1 / 2 * at.first[i]);
            });
    }
}

}  // namespace

template <typename Number>
void take_etd_stage(const WaveBlock<Number>& block, const DiffusionTerms<Number>& f,
                    WaveResponse response, const EtdMemory<Number>& memory,
                    std::vector<Number>& damping) {
    const std::int64_t parts = block.is_complex ? 2 : 1;
    for (std::int64_t n = 0; n < block.lines; ++n) {
        const std::int64_t waves = n * block.count, elements = waves * parts;
        Number *const phi1 = memory[3] + waves, *const phi2 = memory[4] + waves,
                      *const phi3 = memory[5] + waves;
        find_damping(block, n, f, damping);
        if (response == WaveResponse::etd_first) find_phi(damping, phi1, phi2, phi3);
        const Line<Number> line{block.waves[0] + elements,
                                block.waves.size() > 1 ? block.waves[1] + elements : nullptr,
                                memory[0] + elements,
                                memory[1] + elements,
                                memory[2] + elements,
                                phi1,
                                phi2,
                                phi3};
        const auto part = static_cast<Number>(1 / block.gain);
        if (block.is_complex) {
            take_stage<2>(line, damping, response, part);
        } else {
            take_stage<1>(line, damping, response, part);
        }
    }
}

template void take_etd_stage(const WaveBlock<float>&, const DiffusionTerms<float>&, WaveResponse,
                             const EtdMemory<float>&, std::vector<float>&);
template void take_etd_stage(const WaveBlock<double>&, const DiffusionTerms<double>&, WaveResponse,
                             const EtdMemory<double>&, std::vector<double>&);

}  // namespace cascade
