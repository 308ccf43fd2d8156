// The reactions of the library's systems without space: oscillations that grow or fade.
// tests/scripts/library has steady states, thresholds and conserved sums.
#include "tests/models/model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade::models {
namespace {

constexpr const char* two_cells = "grid: 2";

/// The growth rate of an oscillation about a level, from its extremes in two intervals of `steps`
/// steps.
double swing_growth(Model& model, const std::string& species, double level, double time_step,
                    std::int64_t steps) {
    const auto swing = [&] {
        double largest = 0;
        for (int k = 0; k < 200; ++k) {
            model.step(steps / 200);
            largest = std::max(largest, std::abs(model.at(species, 0) - level));
        }
        return largest;
    };
    const double first = swing();
    const double second = swing();
    return std::log(second / first) / (time_step * static_cast<double>(steps));
}

/// The flat state begins to oscillate at B = 1 + A², and near this value oscillations grow at the
/// rate (B − 1 − A²) / 2 (I. Prigogine, R. Lefever 1968). Euler's rule adds ω² dt / 2 with ω = A.
TEST(Kinetics, BrusselatorHopf) {
    for (const double excess : {-0.1, 0.1}) {
        const double decay = 2 + excess, step = 0.002;
        Model model("brusselator", two_cells,
                    "speed: 0.002; feed: 1; u: 1.006; v: " + std::to_string(decay) +
                        "; decay: " + std::to_string(decay));
        const double growth = swing_growth(model, "u", 1, step, 9400);
        EXPECT_NEAR(growth, excess / 2 + step / 2, 0.004) << decay;
    }
}

/// The flat state oscillates if supply² lies between (1 − 2a ∓ √(1 − 8a)) / 2 (E. E. Sel'kov 1968).
TEST(Kinetics, SelkovSwingsBetweenTwoSupplies) {
    const double leak = 0.06;
    const double root = std::sqrt(1 - 8 * leak);
    for (const double sign : {-1.0, 1.0}) {
        const double edge = std::sqrt((1 - 2 * leak + sign * root) / 2);
        for (const double shift : {-0.04, 0.04}) {
            const double supply = edge + shift;
            const double rest = supply / (leak + supply * supply);
            Model model("selkov", two_cells,
                        "speed: 0.001; x_adp: [supply] + 0.001; y_f6p: " + std::to_string(rest) +
                            "; leak: 0.06; supply: " + std::to_string(supply));
            const double growth = swing_growth(model, "x_adp", supply, 0.001, 30000);
            EXPECT_EQ(growth > 0, sign * shift < 0) << supply << " " << growth;
        }
    }
}

/// The maximum of the prey's nullcline is at (1 − half) / 2. The flat state is stable to the right
/// of the maximum and oscillates to the left (M. L. Rosenzweig, Science 171, 1971).
TEST(Kinetics, RosenzweigMacarthurParadoxOfEnrichment) {
    for (const double shift : {-0.05, 0.05}) {
        const double half = 0.4, prey = (1 - half) / 2 + shift, gain = 2;
        const double death = gain * prey / (prey + half);
        const double predator = (1 - prey) * (prey + half);
        Model model("rosenzweig_macarthur", two_cells,
                    "speed: 0.001; half: 0.4; gain: 2; death: " + std::to_string(death) +
                        "; prey: " + std::to_string(prey + 0.001) +
                        "; predator: " + std::to_string(predator));
        const double growth = swing_growth(model, "prey", prey, 0.001, 60000);
        EXPECT_EQ(growth > 0, shift < 0) << growth;
    }
}

/// About a = b = c = μ / (3 μ + σ) oscillations grow at the rate μ σ / (2 (3 μ + σ)) with the
/// angular frequency √3/2 · μ σ / (3 μ + σ) (E. Frey, Physica A 389, 2010). Euler's method adds ω²
/// dt / 2 to the rate.
TEST(Kinetics, RockScissorsPaperSpiralsOutward) {
    Model model("rock_scissors_paper", two_cells,
                "speed: 0.01; a: 0.253; b: 0.25; c: 0.247; growth: 1; defeat: 1");
    const double growth = swing_growth(model, "a", 0.25, 0.01, 1200);
    const double turn = std::sqrt(3.0) / 2 / 4;
    EXPECT_NEAR(growth / (1.0 / 8 + turn * turn * 0.005), 1, 0.1);
}

}  // namespace
}  // namespace cascade::models
