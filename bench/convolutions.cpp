// cascade_convolution_bench: a weighted sum over the cells around each cell of a periodic plane, on
// one core. Compares Cascade, which chooses between sums and transforms, with straight C++ loops
// and with FFTW as its manual describes it, with estimated plans.
//
// All flags of Google Benchmark work. Arguments of cases are the side of the plane and the reach,
// in cells.
#include "core/parallel.h"
#include "solvers/convolution.h"

#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

namespace cascade::bench {
namespace {

struct Problem {
    explicit Problem(const benchmark::State& state)
        : side(state.range(0)),
          grid{side, side},
          from(PlaneLayout(grid), Precision::single),
          to(PlaneLayout(grid), Precision::single) {
        const auto reach = static_cast<double>(state.range(1));
        weighted.lags = lags_within(grid, reach).value();
        for (const Lag& lag : weighted.lags) {
            const auto square = static_cast<double>(lag.x * lag.x + lag.y * lag.y);
            weighted.weights.push_back(std::exp(-4 * square / (reach * reach)));
        }
        for (std::int64_t j = 0; j < side; ++j) {
            for (std::int64_t i = 0; i < side; ++i) {
                from.at(i, j) = static_cast<float>(std::sin(0.3 * static_cast<double>(i * j % 97)));
            }
        }
    }

    std::int64_t side;
    Grid grid;
    WeightedLags weighted;
    Field from, to;
};

void count(benchmark::State& state, const Problem& problem) {
    state.counters["lags"] = static_cast<double>(problem.weighted.lags.size());
    state.SetItemsProcessed(state.iterations() * problem.side * problem.side);
}

void ours(benchmark::State& state) {
    Problem problem(state);
    ConvolutionRunner<float> runner(problem.grid, problem.weighted);
    Team team(1);
    for (auto turn : state) {
        team.run([&](int thread) {
            runner.apply(team, thread, 1, problem.from.origin(), problem.to.origin());
        });
        benchmark::ClobberMemory();
    }
    count(state, problem);
}

/// Loops over a copy with a border as wide as the weights reach, so that sums of a row are loops
/// over adjacent numbers.
void straight_loops(benchmark::State& state) {
    Problem problem(state);
    const std::int64_t reach = state.range(1), side = problem.side, width = side + 2 * reach;
    std::vector<float> padded(static_cast<std::size_t>(width * width));
    std::vector<float> sums(static_cast<std::size_t>(side * side));
    const auto wrapped = [&](std::int64_t k) { return (k + side) % side; };
    for (auto turn : state) {
        for (std::int64_t j = 0; j < width; ++j) {
            for (std::int64_t i = 0; i < width; ++i) {
                padded[static_cast<std::size_t>(j * width + i)] =
                    problem.from.at(wrapped(i - reach), wrapped(j - reach));
            }
        }
        for (std::int64_t j = 0; j < side; ++j) {
            float* const row = sums.data() + j * side;
            std::fill_n(row, side, 0.0F);
            for (std::size_t n = 0; n < problem.weighted.lags.size(); ++n) {
                const Lag& lag = problem.weighted.lags[n];
                const auto weight = static_cast<float>(problem.weighted.weights[n]);
                const float* const seen =
                    padded.data() + (j + lag.y + reach) * width + lag.x + reach;
                for (std::int64_t i = 0; i < side; ++i) row[i] += weight * seen[i];
            }
        }
        benchmark::DoNotOptimize(sums.data());
        benchmark::ClobberMemory();
    }
    count(state, problem);
}

void plain_fftw(benchmark::State& state) {
    Problem problem(state);
    const auto side = static_cast<int>(problem.side);
    const std::size_t cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    const std::size_t waves =
        static_cast<std::size_t>(side) * static_cast<std::size_t>(side / 2 + 1);
    float* const values = fftwf_alloc_real(cells);
    fftwf_complex* const spectrum = fftwf_alloc_complex(waves);
    fftwf_plan forward = fftwf_plan_dft_r2c_2d(side, side, values, spectrum, FFTW_ESTIMATE);
    fftwf_plan backward = fftwf_plan_dft_c2r_2d(side, side, spectrum, values, FFTW_ESTIMATE);
    std::fill_n(values, cells, 0.0F);
    for (std::size_t n = 0; n < problem.weighted.lags.size(); ++n) {
        const Lag& lag = problem.weighted.lags[n];
        const std::int64_t i = (side - lag.x) % side, j = (side - lag.y) % side;
        values[j * side + i] += static_cast<float>(problem.weighted.weights[n]);
    }
    fftwf_execute(forward);
    const auto* const found = reinterpret_cast<std::complex<float>*>(spectrum);
    const std::vector<std::complex<float>> factors(found, found + waves);
    for (auto turn : state) {
        for (int j = 0; j < side; ++j) std::copy_n(problem.from.row(j), side, values + j * side);
        fftwf_execute(forward);
        auto* const wave = reinterpret_cast<std::complex<float>*>(spectrum);
        for (std::size_t k = 0; k < waves; ++k) wave[k] *= factors[k] / static_cast<float>(cells);
        fftwf_execute(backward);
        for (int j = 0; j < side; ++j) {
            std::copy_n(values + j * side, side, &problem.to.at(0, j));
        }
        benchmark::ClobberMemory();
    }
    count(state, problem);
    fftwf_destroy_plan(forward);
    fftwf_destroy_plan(backward);
    fftwf_free(values);
    fftwf_free(spectrum);
}

void sizes(benchmark::internal::Benchmark* each) {
    for (const std::int64_t side : {256, 1024}) {
        for (const std::int64_t reach : {2, 6, 18}) each->Args({side, reach});
    }
}

BENCHMARK(ours)->Apply(sizes);
BENCHMARK(straight_loops)->Apply(sizes);
BENCHMARK(plain_fftw)->Apply(sizes);

}  // namespace
}  // namespace cascade::bench

BENCHMARK_MAIN();
