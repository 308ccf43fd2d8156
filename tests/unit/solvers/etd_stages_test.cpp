// The stages of etdrk4, tested with equations of one wave whose solutions are known.
#include "solvers/etd_stages.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace cascade {
namespace {

struct Found {
    double end, error;
};

/// Takes one step of length 1 from u = 1. Diffusion gives the rate −x u, and `rest` is the rest of
/// the rate.
Found step(double x, const std::function<double(double u)>& rest) {
    const double along = -1, none = 0;
    double rate = 0, error = 0;
    std::array<double, etd_registers> kept{};
    EtdMemory<double> memory;
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = &kept[k];
    std::vector<double*> waves{&rate, &error};
    WaveBlock<double> block;
    block.lines = block.count = 1;
    block.differences[0] = &along;
    block.differences[1] = block.differences[2] = &none;
    block.waves = waves;
    double u = 1;
    std::vector<double> damping;
    for (const WaveResponse stage : {WaveResponse::etd_first, WaveResponse::etd_second,
                                     WaveResponse::etd_third, WaveResponse::etd_last}) {
        rate = -x * u + rest(u);
        take_etd_stage<double>(block, {x}, stage, memory, damping);
        u = 1 + rate;
    }
    return {u, error};
}

TEST(EtdStages, SolveDiffusionExactly) {
    for (double x = 1e-9; x < 1e9; x *= 1.9) {
        const double decay = std::exp(-x);
        EXPECT_NEAR(step(x, [](double) { return 0; }).end, decay, 2e-14) << x;
        // With a constant source the step is exact, too.
        const Found beside = step(x, [](double) { return 3; });
        EXPECT_NEAR(beside.end, decay + 3 * -std::expm1(-x) / x, 2e-14) << x;
        EXPECT_NEAR(beside.error, 0, 1e-14) << x;
    }
}

/// Where a coefficient varies, part of the diffusion is in the rest of the rate. The solution
/// decays in this case too, however stiff it is.
TEST(EtdStages, DecayWhereDiffusionIsLessThanItIsTakenFor) {
    for (double x = 0.1; x < 1e6; x *= 1.3) {
        for (double part = 0; part <= 1; part += 0.05) {
            const double end = step(x, [&](double u) { return part * x * u; }).end;
            EXPECT_LE(std::abs(end), 1 + 1e-12) << x << " " << part;
        }
    }
}

/// Measures the orders of the step and of its error for u' = −x u + (x + 1) u, with steps of length
/// h = x.
TEST(EtdStages, AreOfFourthOrderAndTheirErrorOfThird) {
    const auto shortened = [](double h) {
        return step(2 * h, [&](double u) { return 3 * h * u; });
    };
    const Found coarse = shortened(0.04), fine = shortened(0.02);
    EXPECT_NEAR(std::log2((coarse.end - std::exp(0.04)) / (fine.end - std::exp(0.02))), 5, 0.1);
    EXPECT_NEAR(std::log2(coarse.error / fine.error), 3, 0.1);
}

}  // namespace
}  // namespace cascade
